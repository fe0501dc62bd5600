/* Preloaded into a process: makes one of its system calls that write fail, or kills it there.
 *
 * DISK_BELOW  only calls on paths that contain this text count
 * DISK_AT     the how manieth of them, from 1
 * DISK_ERROR  an error number; `kill` instead ends the process before the call
 * DISK_FOREVER  if set, all calls after it fail too
 * DISK_COUNT  a file that is made as long as the number of calls, when the process ends by itself */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static _Atomic long calls;

static int fails(const char *path) {
    const char *below = getenv("DISK_BELOW"), *at = getenv("DISK_AT"), *error = getenv("DISK_ERROR");
    if (!below || !path || !strstr(path, below)) return 0;
    long call = ++calls;
    if (!at || !error || call < atol(at) || (call > atol(at) && !getenv("DISK_FOREVER"))) return 0;
    if (!strcmp(error, "kill")) kill(getpid(), SIGKILL);
    errno = atoi(error);
    return 1;
}

static int fails_fd(int fd) {
    char link[64], path[4096];
    struct stat there;
    int (*stat_fd)(int, struct stat *) = fstat;
    if (stat_fd(fd, &there) || !(S_ISREG(there.st_mode) || S_ISDIR(there.st_mode))) return 0;
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return 0;
    path[length] = 0;
    return fails(path);
}

static int fails_at(int folder, const char *path) {
    char link[64], whole[8192];
    if (path[0] == '/' || folder == AT_FDCWD) return fails(path);
    snprintf(link, sizeof link, "/proc/self/fd/%d", folder);
    ssize_t length = readlink(link, whole, 4000);
    if (length < 0) return 0;
    snprintf(whole + length, sizeof whole - length, "/%s", path);
    return fails(whole);
}

#define REAL(name) __typeof__(&name) real = (__typeof__(&name))dlsym(RTLD_NEXT, #name)
#define WRITES(flags) ((flags) & (O_CREAT | O_WRONLY | O_RDWR))
#define MODE(flags) \
    mode_t mode = 0; \
    if ((flags) & O_CREAT) { va_list list; va_start(list, flags); mode = va_arg(list, mode_t); va_end(list); }

int open(const char *path, int flags, ...) { MODE(flags) REAL(open); return WRITES(flags) && fails(path) ? -1 : real(path, flags, mode); }
int open64(const char *path, int flags, ...) { MODE(flags) REAL(open64); return WRITES(flags) && fails(path) ? -1 : real(path, flags, mode); }
int openat(int folder, const char *path, int flags, ...) { MODE(flags) REAL(openat); return WRITES(flags) && fails_at(folder, path) ? -1 : real(folder, path, flags, mode); }
int openat64(int folder, const char *path, int flags, ...) { MODE(flags) REAL(openat64); return WRITES(flags) && fails_at(folder, path) ? -1 : real(folder, path, flags, mode); }
ssize_t write(int fd, const void *bytes, size_t count) {
    REAL(write);
    if (!fails_fd(fd)) return real(fd, bytes, count);
    /* A full disk takes some of the bytes first. */
    if (count > 1 && errno == ENOSPC) real(fd, bytes, count / 2), errno = ENOSPC;
    return -1;
}
int fsync(int fd) { REAL(fsync); return fails_fd(fd) ? -1 : real(fd); }
int fdatasync(int fd) { REAL(fdatasync); return fails_fd(fd) ? -1 : real(fd); }
int mkdir(const char *path, mode_t mode) { REAL(mkdir); return fails(path) ? -1 : real(path, mode); }
int rename(const char *from, const char *to) { REAL(rename); return fails(to) ? -1 : real(from, to); }
int unlink(const char *path) { REAL(unlink); return fails(path) ? -1 : real(path); }
int unlinkat(int folder, const char *path, int flags) { REAL(unlinkat); return fails_at(folder, path) ? -1 : real(folder, path, flags); }
int rmdir(const char *path) { REAL(rmdir); return fails(path) ? -1 : real(path); }

__attribute__((destructor)) static void count(void) {
    const char *path = getenv("DISK_COUNT");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (file) fprintf(file, "%ld\n", (long)calls), fclose(file);
}
