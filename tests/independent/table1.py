"""Makespan of a cell of Table I, calculated apart from autogen.

    python3 table1.py LAYOUT.json SCENARIO.json PARTS_PER_TRIP

Reads the layout and the scenario, and nothing else of the project. The prototype's controllers (V1) are
written here a second time, by hand, from their description, and so are the plant's laws: forward and
inverse kinematics of both arms, synchronised joint motion, gripper, belt, vehicles. Prints the number of
scans until the last order is made.
"""

import json
import math
import sys

SCAN = 10  # ms
STARTS_AT = 2  # the operator's start edge, in scans

# UR10 (Universal Robots), m. The vacuum gripper stands in place of the flange, 0.1 m long.
UPPER, FORE = 0.612, 0.5723
SHOULDER, ELBOW_SIDE, WRIST = 0.1273, 0.163941, 0.1157
TOOL = 0.1
# Full speed: rail m/s; torso, then pan, lift, elbow, first wrist rad/s.
RAIL, TORSO, PAN, LIFT, ELBOW, WRIST_1 = 1.0, math.pi / 4, 2.16, 2.16, 3.15, 3.2
GAIN = 1.0
PACE = 0.1

BELT_SURFACE, BELT_SPEED = 0.875, 0.2
CAMERA_HALF = 0.56 - 0.07  # a part lies wholly in the field
TRAY_SURFACE = 0.755
VEHICLE_SPEED, VEHICLE_LATENCY = 3.334 / 3.0, 750
CONTACT, POLL = 0.005, 100  # m, ms


def lift_and_elbow(out, up):
    """Angles that bring the wrist so far out and up from the shoulder, elbow up."""
    cosine = (out * out + up * up - UPPER * UPPER - FORE * FORE) / (2 * UPPER * FORE)
    elbow = math.acos(cosine)
    lift = math.atan2(-up, out) - math.atan2(FORE * math.sin(elbow), UPPER + FORE * math.cos(elbow))
    return lift, elbow


def out_and_up(lift, elbow):
    return (
        UPPER * math.cos(lift) + FORE * math.cos(lift + elbow),
        -UPPER * math.sin(lift) - FORE * math.sin(lift + elbow),
    )


class RailArm:
    """Joints: rail, pan, lift, elbow, first wrist. The arm stands square to the rail where the rail is long enough."""

    limits = [RAIL, PAN, LIFT, ELBOW, WRIST_1]

    def __init__(self, machine):
        self.x, _, self.height = machine["pose"]
        self.low, self.high = machine["rail_range"]

    def joints(self, goal, present):
        x, y, z = goal
        across = x - self.x
        place = y - (ELBOW_SIDE if across >= 0 else -ELBOW_SIDE)
        place = min(max(place, self.low), self.high)
        along = y - place
        reach = math.sqrt(across * across + along * along - ELBOW_SIDE * ELBOW_SIDE)
        pan = math.atan2(along, across) - math.atan2(ELBOW_SIDE, reach)
        # The turn nearest to the present one; of two that are as near, the one in (-pi, pi].
        pan = pan - 2 * math.pi * math.ceil((pan - math.pi) / (2 * math.pi))
        for other in (pan - 2 * math.pi, pan + 2 * math.pi):
            if abs(other) <= 2 * math.pi and abs(other - present[1]) < abs(pan - present[1]):
                pan = other
        lift, elbow = lift_and_elbow(reach - WRIST, z + TOOL - self.height)
        return [place, pan, lift, elbow, -lift - elbow]

    def tool(self, joints):
        place, pan, lift, elbow, _ = joints
        out, up = out_and_up(lift, elbow)
        reach = out + WRIST
        return (
            self.x + reach * math.cos(pan) - ELBOW_SIDE * math.sin(pan),
            place + reach * math.sin(pan) + ELBOW_SIDE * math.cos(pan),
            self.height + up - TOOL,
        )

    def rest(self):
        middle = (self.low + self.high) / 2
        goal = (self.x + 0.574, middle + 0.163, self.height + 0.402)
        return self.joints(goal, [middle, 0, 0, 0, 0])


class GantryArm:
    """Joints: torso's x and y, its turn, lift, elbow, first wrist. The tool hangs under the shoulder."""

    limits = [RAIL, RAIL, TORSO, LIFT, ELBOW, WRIST_1]
    ahead = 0.51 + SHOULDER

    def __init__(self, machine):
        self.height = machine["pose"][2]
        self.middle = [sum(machine[key]) / 2 for key in ("x_rail_range", "y_rail_range")]

    def joints(self, goal, turn):
        x, y, z = goal
        s, c = math.sin(turn), math.cos(turn)
        lift, elbow = lift_and_elbow(WRIST, z + TOOL - self.height)
        return [
            x + self.ahead * s + ELBOW_SIDE * c,
            y - self.ahead * c + ELBOW_SIDE * s,
            turn,
            lift,
            elbow,
            -lift - elbow,
        ]

    def tool(self, joints):
        x, y, turn, lift, elbow, _ = joints
        out, up = out_and_up(lift, elbow)
        ahead = self.ahead + out - WRIST
        s, c = math.sin(turn), math.cos(turn)
        return (
            x - ahead * s - ELBOW_SIDE * c,
            y + ahead * c - ELBOW_SIDE * s,
            self.height + up - TOOL,
        )

    def rest(self):
        return self.joints((*self.middle, self.height - 0.776), 0.0)


class Drive:
    """All joints together on a straight line: speed is gained, kept, lost as fast as the slowest joint allows."""

    def __init__(self, arm):
        self.arm = arm
        self.start = self.goal = self.now = arm.rest()
        self.begin = self.end = 0.0
        self.top = self.gain = 1.0
        self.under_way = False
        self.vacuum, self.polls, self.part, self.hang = False, 0, None, None

    def go(self, goal, scan):
        ways = [abs(b - a) for a, b in zip(self.now, goal)]
        self.start, self.goal, self.begin = self.now, goal, scan * SCAN / 1000
        self.under_way = True
        if max(ways) == 0:
            self.end = self.begin
            return
        self.top = min(v * PACE / w for v, w in zip(self.arm.limits, ways) if w > 0)
        self.gain = min(GAIN / w for w in ways if w > 0)
        full = self.top * self.top < self.gain
        self.end = self.begin + (1 / self.top + self.top / self.gain if full else 2 / math.sqrt(self.gain))

    def advance(self, scan):
        """To the start of the next scan."""
        t = (scan + 1) * SCAN / 1000
        if not self.under_way:
            return
        if t >= self.end:
            self.now, self.under_way = self.goal, False
            return
        peak = min(self.top, math.sqrt(self.gain))
        rise, passed, left = peak / self.gain, t - self.begin, self.end - t
        if passed < rise:
            share = self.gain * passed * passed / 2
        elif left < rise:
            share = 1 - self.gain * left * left / 2
        else:
            share = peak * (passed - rise / 2)
        self.now = [a + share * (b - a) for a, b in zip(self.start, self.goal)]

    def tool(self):
        return self.arm.tool(self.now)

    def poll(self, scan, parts, place_of):
        """Twice in a row, each 0.1 s, in contact with the point at which a part is gripped."""
        if not self.vacuum or self.part is not None or (scan + 1) * SCAN % POLL:
            return
        tool, near = self.tool(), []
        for part in parts:
            place = place_of(part)
            if place is not None:
                gap = math.dist(tool, (place[0], place[1], place[2] + part["height"]))
                near.append((gap, part["number"], part, place))
        near = [n for n in near if n[0] <= CONTACT]
        self.polls = self.polls + 1 if near else 0
        if self.polls == 2:
            self.polls = 0
            _, _, self.part, place = min(near)
            self.hang = [p - t for p, t in zip(place, tool)]
            self.part["on"] = self


class Belt:
    def __init__(self, machine, scenario):
        self.x, self.middle, _ = machine["pose"]
        self.upper = machine["orient_range"][1] - 0.7
        self.running, self.travelled, self.answers = False, 0, False
        heights = {kind["name"]: kind["height"] for kind in scenario["kinds"]}
        supply = scenario["supply"]
        self.parts = []
        for number, kind in enumerate(supply["items"]):
            at = int(1000 * (supply["first_s"] + number * supply["every_s"]))
            self.parts.append({"number": number, "kind": kind, "height": heights[kind], "at": at, "on": None})

    def advance(self):
        self.answers = True
        if self.running:
            self.travelled += SCAN
            for part in self.parts:
                if part["on"] is None and part["at"] <= self.travelled:
                    part["on"] = self

    def place(self, part):
        along = self.upper + BELT_SPEED * part["at"] / 1000 - BELT_SPEED * self.travelled / 1000
        return (self.x, along, BELT_SURFACE)

    def seen(self, kind):
        """Where the foremost part of a kind lies under the camera."""
        places = [self.place(p) for p in self.parts if p["on"] is self and p["kind"] == kind]
        places = [p for p in places if abs(p[1] - self.middle) <= CAMERA_HALF]
        return min(places, key=lambda p: p[1]) if places else None


class Vehicle:
    def __init__(self, machine):
        self.home, self.stop = machine["pose"], machine["destinations"][0]
        self.way = math.dist(self.home, self.stop)
        self.elapsed, self.under_way, self.arrived = 0, False, False
        # Cells: what kitting robot and gantry know of it.
        self.near, self.carries, self.trip, self.call = False, [], 0, False
        self.number, self.offer, self.kind, self.at = 0, False, None, None
        self.taken, self.emptied = False, False
        self.state, self.next = "AtStart", 0

    def position(self):
        return self.stop if self.arrived else self.home

    def slot(self, at, i):
        """The prototype's eight places: two rows of four, the first 0.2 m further than the tray's own."""
        i += 4
        return (at[0] - 0.014 + 0.2 * (i // 4), at[1] - 0.18 + 0.12 * (i % 4), at[2] + TRAY_SURFACE)

    def advance(self):
        if self.under_way:
            self.elapsed += SCAN
            gone = VEHICLE_SPEED * (self.elapsed - VEHICLE_LATENCY) / 1000
            if self.elapsed >= VEHICLE_LATENCY and gone >= self.way:
                self.under_way, self.arrived = False, True

    def step(self):
        if self.state == "AtStart" and self.call:
            self.call, self.under_way, self.state = False, True, "Moving"
        elif self.state == "Moving" and self.arrived and self.near:
            self.number, self.next, self.state = self.trip, 0, "AtStation"
        elif self.state == "AtStation":
            if self.taken:
                self.taken, self.offer, self.next = False, False, self.next + 1
            elif not self.offer and self.next < len(self.carries):
                self.kind, self.at = self.carries[self.next], self.slot(self.stop, self.next)
                self.offer = True


class Line:
    def __init__(self, layout, scenario, per_trip):
        robots = layout["robots"]
        of_type = lambda wanted: [r for r in robots if r["type"] == wanted]
        order = ["conveyor", "kitting", "agv", "gantry"]
        steps = [order.index(r["type"]) for r in robots]
        assert steps == sorted(steps), "the steps below are made in this order"
        self.belt = Belt(of_type("conveyor")[0], scenario)
        self.rail = Drive(RailArm(of_type("kitting")[0]))
        self.gantry = Drive(GantryArm(of_type("gantry")[0]))
        self.vehicles = [Vehicle(r) for r in of_type("agv")]
        self.per_trip = per_trip
        self.kinds = [kind["name"] for kind in scenario["kinds"]]
        self.orders = [next(iter(order["parts"])) for order in scenario["orders"]]
        self.left = {kind: self.orders.count(kind) for kind in self.kinds}
        trips = -(-len(self.orders) // per_trip)
        assert trips <= len(self.vehicles), f"{trips} trips, {len(self.vehicles)} AGVs that go once"
        self.made, self.count_down = 0, False
        self.scan = 0

        self.b_state, self.b_kind, self.b_offer, self.b_at, self.b_run = "Begin", None, False, None, False
        self.k_state, self.k_since, self.k_kind, self.k_agv = "Begin", 0, None, None
        self.k_found = dict.fromkeys(self.kinds, 0)
        self.k_trips = 0
        self.g_state, self.g_since, self.g_kind, self.g_agv = "Begin", 0, None, None
        self.g_found = dict.fromkeys(self.kinds, 0)
        self.g_part = self.g_turn = self.g_x = self.g_drop = None
        self.paced = {}

    # Controllers. A state entered in this scan is tested from the next one on.

    def conveyor(self):
        belt = self.belt
        if self.b_state == "Begin":
            self.drive_belt(True, "Moving")
        elif self.b_state == "Moving":
            for kind in self.kinds:
                if belt.seen(kind) and self.left[kind] > 0:
                    self.b_kind = kind
                    self.drive_belt(False, "Paused")
                    return
        elif self.b_state == "Paused":
            if self.b_run:
                self.b_run, self.b_offer = False, False
                self.drive_belt(True, "Moving")
            elif belt.answers and not self.b_offer:
                self.b_at, self.b_offer = belt.seen(self.b_kind), True

    def drive_belt(self, running, state):
        self.belt.running, self.belt.answers, self.b_state = running, False, state

    def kitting(self):
        arm, state, since = self.rail, self.k_state, self.scan - self.k_since
        done = not arm.under_way
        if state == "Begin":
            self.k_enter("Setting")
        elif state == "Setting" and since >= 1:
            self.k_enter("Deciding")
        elif state == "Deciding":
            if sum(self.left.values()) > 0:
                self.k_move((self.belt.x, 0.591, 1.5), "Homing")
            else:
                self.k_enter("Over")
        elif state == "Homing" and done:
            arm.vacuum = True
            self.k_enter("Waiting")
        elif state == "Waiting" and self.b_offer:
            self.k_kind = self.b_kind
            self.k_enter("Looking")
        elif state == "Looking" and since * SCAN >= 1000 * self.k_found[self.k_kind]:
            self.k_found[self.k_kind] += 1
            x, y, z = self.b_at
            self.k_move((x, y, z + self.height(self.k_kind) / 2 + 0.03), "Approaching")
        elif state == "Approaching" and done:
            self.k_lower()
        elif state == "Lowering" and done:
            if arm.part is None:
                self.k_lower()
            else:
                x, y, z = arm.tool()
                self.k_move((x, y, z + 0.5), "Lifting")
        elif state == "Lifting" and done:
            self.b_run = True
            self.k_enter("Choosing")
        elif state == "Choosing":
            free = [v for v in self.vehicles if not v.near and len(v.carries) < self.per_trip]
            if free:
                tool = arm.tool()
                self.k_agv = min(free, key=lambda v: math.dist(v.home, tool) ** 2)
                x, y, _ = self.k_agv.slot(self.k_agv.home, len(self.k_agv.carries))
                self.k_move((x, y, 0.88), "Carrying")
        elif state == "Carrying" and done:
            arm.vacuum = False
            self.k_enter("Dropping")
        elif state == "Dropping" and arm.part is None:
            self.k_agv.carries.append(self.k_kind)
            self.left[self.k_kind] -= 1
            self.k_enter("Sending")
        elif state == "Sending":
            if len(self.k_agv.carries) < self.per_trip:
                self.k_enter("Deciding")
            elif since * SCAN >= 2000:
                self.k_agv.call = True
                self.k_enter("Gone")
        elif state == "Gone" and since * SCAN >= 4500:
            self.k_trips += 1
            self.k_agv.trip, self.k_agv.near = self.k_trips, True
            self.k_enter("Deciding")

    def k_enter(self, state):
        self.k_state, self.k_since = state, self.scan

    def k_move(self, goal, state):
        self.rail.go(self.rail.arm.joints(goal, self.rail.now), self.scan)
        self.k_enter(state)

    def k_lower(self):
        x, y, z = self.rail.tool()
        self.k_move((x, y, z - 0.002), "Lowering")

    def crane(self):
        arm, state, since = self.gantry, self.g_state, self.scan - self.g_since
        done = not arm.under_way
        quarter = math.pi / 2
        tool = arm.tool
        if state == "Begin":
            self.g_enter("Setting")
        elif state == "Setting" and since >= 1:
            self.g_move((-4, 0, 0.8), quarter, "Homing")
        elif state == "Homing" and done:
            self.g_enter("Waiting")
        elif state == "Waiting":
            waiting = [v for v in self.vehicles if v.number > 0 and not v.emptied]
            if waiting:
                self.g_agv = min(waiting, key=lambda v: v.number)
                self.g_enter("Next")
        elif state == "Next":
            self.g_enter("Leaving")
        elif state == "Leaving":
            y = self.g_agv.stop[1]
            self.g_turn = 0.0 if (y > 3.02 or -3.02 <= y <= 0) else math.pi
            self.g_move((-5.6, math.copysign(3.02, y), tool()[2]), self.g_turn, "Passing")
        elif state == "Passing" and done:
            self.g_enter("Looking")
        elif state == "Looking":
            agv = self.g_agv
            if agv.offer:
                if since * SCAN >= 1000 * self.g_found[agv.kind]:
                    x, y, z = agv.at
                    self.g_kind, self.g_part = agv.kind, (x, y, z + self.height(agv.kind) / 2)
                    self.g_found[agv.kind] += 1
                    arm.vacuum = True
                    self.g_enter("Found")
            elif since * SCAN >= 10_000:
                agv.emptied = True
                self.g_enter("Empty")
        elif state == "Found":
            x, y, z = self.g_part
            self.g_move((x, y, z + 0.06), self.g_turn, "Approaching")
        elif state == "Empty":
            self.g_move((-4, 0, 0.8), quarter, "Homing")
        elif state == "Approaching" and done:
            self.g_by((0, 0, -0.002), self.g_turn, "Lowering")
        elif state == "Lowering" and done:
            if arm.part is None:
                self.g_by((0, 0, -0.002), self.g_turn, "Lowering")
            else:
                self.g_x = tool()[0]
                self.g_by((0, 0, 0.1), self.g_turn, "Lifting")
        elif state == "Lifting" and done:
            self.g_agv.taken = True
            self.g_enter("Choosing")
        elif state == "Choosing":
            self.g_drop = (-7.1, 3.1, 1.4 + 0.03)
            self.g_move((self.g_x, *self.g_drop[1:]), self.g_turn, "Crossing")
        elif state == "Crossing" and done:
            self.g_move((self.g_x, *self.g_drop[1:]), quarter, "Rounding")
        elif state == "Rounding" and done:
            self.g_move(self.g_drop, quarter, "Entering")
        elif state == "Entering" and done:
            arm.vacuum = False
            self.g_enter("Dropping")
        elif state == "Dropping" and since * SCAN >= 1000:
            self.g_by((1.1, 0, 0), quarter, "Retreating")
        elif state == "Retreating" and done:
            self.count_down = True
            self.g_enter("Next")

    def g_enter(self, state):
        self.g_state, self.g_since = state, self.scan

    def g_move(self, goal, turn, state):
        self.gantry.go(self.gantry.arm.joints(goal, turn), self.scan)
        self.g_enter(state)

    def g_by(self, way, turn, state):
        self.g_move(tuple(a + b for a, b in zip(self.gantry.tool(), way)), turn, state)

    def station(self):
        """Has the briefcase taken away as soon as its part is counted down."""
        if self.count_down:
            self.count_down = False
            assert self.g_kind == self.orders[self.made], "the next order wants another part"
            self.made += 1

    def height(self, kind):
        return next(p["height"] for p in self.belt.parts if p["kind"] == kind)

    # Plant.

    def place(self, part):
        on = part["on"]
        if on is self.belt:
            return self.belt.place(part)
        if isinstance(on, Vehicle):
            return tuple(a + b for a, b in zip(on.position(), part["offset"]))
        return None

    def let_go(self):
        for drive in (self.rail, self.gantry):
            if not drive.vacuum:
                drive.polls = 0
                if drive.part is not None:
                    self.put(drive)

    def put(self, drive):
        x, y, _ = (a + b for a, b in zip(drive.tool(), drive.hang))
        if drive is self.rail:
            at = self.k_agv.position()
            drive.part["on"], drive.part["offset"] = self.k_agv, (x - at[0], y - at[1], TRAY_SURFACE)
        else:
            drive.part["on"] = "station"
        drive.part = None

    def run(self):
        while self.made < len(self.orders):
            if self.scan >= STARTS_AT:
                self.conveyor()
                self.kitting()
                for vehicle in self.vehicles:
                    vehicle.step()
                self.crane()
                self.station()
            self.let_go()
            self.belt.advance()
            for vehicle in self.vehicles:
                vehicle.advance()
            for drive in (self.rail, self.gantry):
                drive.advance(self.scan)
            for drive in (self.rail, self.gantry):
                drive.poll(self.scan, self.belt.parts, self.place)
            self.scan += 1
        return self.scan


def main():
    layout, scenario, per_trip = sys.argv[1:]
    with open(layout) as file:
        layout = json.load(file)
    with open(scenario) as file:
        scenario = json.load(file)
    print(Line(layout, scenario, int(per_trip)).run())


if __name__ == "__main__":
    main()
