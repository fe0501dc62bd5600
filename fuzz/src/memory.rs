//! How much memory an input takes, from the allocator.

use peak_alloc::PeakAlloc;

/// What one input may take at most, bytes.
pub const MOST: usize = 500 << 20;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Does something; returns the most bytes that were allocated meanwhile beyond those from before. What other
/// threads allocate is counted too.
pub fn peak(job: impl FnOnce()) -> usize {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    job();
    ALLOCATOR.peak_usage().saturating_sub(before)
}
