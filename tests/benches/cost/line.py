"""The default line as a model in SimPy: queues and times, no geometry and no scans. Prints simulated s per s.

A belt brings a part every 2 s and waits for the arm; an arm puts parts onto four vehicles; vehicles drive to the
stations; a gantry puts each part into a briefcase; eight orders of four parts. `autogen commission` on this line gives
the times: seconds in which the arm and the gantry move, for each of the 32 parts. A trip is 3.33 m at 1.11 m/s.
"""

import time

import simpy

PARTS, ORDERS, VEHICLES, CAPACITY = 4, 8, 4, 8
EVERY, PICK, TRIP, CARRY = 2.0, 438.03 / 32, 3.33 / 1.11, 551.65 / 32
RUNS = 300


def line(env):
    belt = simpy.Store(env, capacity=1)
    trays = [simpy.Store(env, capacity=CAPACITY) for _ in range(VEHICLES)]
    offered = simpy.Store(env)
    made = env.event()

    def feed():
        while True:
            yield env.timeout(EVERY)
            yield belt.put(env.now)

    def kitting():
        for number in range(PARTS * ORDERS):
            part = yield belt.get()
            yield env.timeout(PICK)
            yield trays[number // CAPACITY % VEHICLES].put(part)

    def vehicle(tray):
        while True:
            load = []
            for _ in range(CAPACITY):
                load.append((yield tray.get()))
            yield env.timeout(TRIP)
            for part in load:
                taken = env.event()
                yield offered.put((part, taken))
                yield taken
            yield env.timeout(TRIP)

    def gantry():
        for _ in range(PARTS * ORDERS):
            _, taken = yield offered.get()
            yield env.timeout(CARRY / 2)
            taken.succeed()
            yield env.timeout(CARRY / 2)
        made.succeed()

    env.process(feed())
    env.process(kitting())
    env.process(gantry())
    for tray in trays:
        env.process(vehicle(tray))
    return made


begin, simulated = time.perf_counter(), 0.0
for _ in range(RUNS):
    env = simpy.Environment()
    env.run(line(env))
    simulated += env.now
print(simulated / (time.perf_counter() - begin))
