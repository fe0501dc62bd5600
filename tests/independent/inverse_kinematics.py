"""Compares the kinematics of six-axis arms with libraries that have nothing in common with this project.

    python3 -m venv target/ik && target/ik/bin/pip install numpy scipy py-opw-kinematics==1.3.0 ur-analytic-ik==0.1.0.post3
    cargo build --release -p autogen-tests --example poses
    target/ik/bin/python tests/independent/inverse_kinematics.py target/release/examples/poses 1000000

The poses come from joints that are drawn. Of each arm are compared: the flange at these joints; the flange at each
solution with the pose; the solutions with those of the library, in both directions, up to whole turns. Near a pose
where the arm is singular the joints are not determined to the last digits: such poses are counted apart, and only the
flange at their solutions is compared.
"""

import subprocess
import sys

import numpy as np
import py_opw_kinematics as opw
import ur_analytic_ik as ur
from scipy.spatial.transform import RigidTransform

# Lengths, offsets in degrees, signs. From files of ROS-Industrial (fanuc, abb, kuka_experimental, motoman, staubli).
OPW = {
    "FANUC M-10iA": ([0.15, -0.2, 0, 0.45, 0.6, 0.64, 0.1], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    "FANUC LR Mate 200iC": ([0.075, -0.075, 0, 0.33, 0.3, 0.32, 0.08], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    "ABB IRB 2400": ([0.1, -0.135, 0, 0.615, 0.705, 0.755, 0.085], [0, 0, -90, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    "ABB IRB 6640": ([0.322, -0.2, 0.011, 0.778, 1.07, 1.395, 0.208], [0, 0, -90, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    "KUKA KR 16-2": ([0.26, 0.035, 0, 0.675, 0.68, 0.67, 0.158], [0, -90, 0, 0, 0, 0], [-1, 1, 1, -1, 1, -1]),
    "KUKA KR 6 R700": ([0.025, -0.035, 0, 0.4, 0.315, 0.365, 0.08], [0, -90, 0, 0, 0, 0], [-1, 1, 1, -1, 1, -1]),
    "Motoman GP7": ([0.04, -0.04, 0, 0.33, 0.445, 0.44, 0.08], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    "Staubli RX160": ([0.15, 0, 0, 0.55, 0.825, 0.625, 0.11], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    "Staubli TX40": ([0, 0, 0.035, 0.32, 0.225, 0.225, 0.065], [0, 0, -90, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    "offset to the side": ([0.2, -0.1, 0.15, 0.5, 0.6, 0.7, 0.1], [10, -20, 30, 40, -50, 60], [1, -1, 1, -1, 1, -1]),
}
# d1, a2, a3, d4, d5, d6 of the manufacturer.
UR = {
    "ur3e": [0.15185, -0.24355, -0.2132, 0.13105, 0.08535, 0.0921],
    "ur5e": [0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996],
    "ur10e": [0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655],
    "ur16e": [0.1807, -0.4784, -0.36, 0.17415, 0.11985, 0.11655],
    "ur20": [0.2363, -0.8620, -0.7287, 0.2010, 0.1593, 0.1543],
    "ur30": [0.2363, -0.6370, -0.5037, 0.2010, 0.1593, 0.1543],
    "ur3": [0.1519, -0.24365, -0.21325, 0.11235, 0.08535, 0.0819],
    "ur5": [0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823],
    "ur10": [0.1273, -0.612, -0.5723, 0.163941, 0.1157, 0.0922],
}
# The same joints, rad; and a pose nearer to a singular one than this is counted apart: a sine, or a part of a length.
SAME = 1e-5
SINGULAR = 1e-3


def turned(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def records(arguments):
    with subprocess.Popen(arguments, stdout=subprocess.PIPE) as process:
        numbers = np.frombuffer(process.stdout.read(), dtype="<f8").reshape(-1, 67)
    assert process.returncode == 0
    poses = np.tile(np.eye(4), (len(numbers), 1, 1))
    poses[:, :3, :] = numbers[:, 6:18].reshape(-1, 3, 4)
    return numbers[:, :6], poses, numbers[:, 19:].reshape(-1, 8, 6)


def unmatched(ours, theirs):
    """Solutions of each pose that the other side does not have; NaN are none."""
    count = np.zeros(len(ours), dtype=int)
    for one in range(ours.shape[1]):
        there = ~np.isnan(ours[:, one, 0])
        apart = np.abs(turned(ours[:, one : one + 1, :] - theirs)).max(axis=2)
        found = (np.where(np.isnan(apart), np.inf, apart) < SAME).any(axis=1)
        count += there & ~found
    return count


def report(name, joints, poses, solutions, forward, theirs, singular):
    difference = np.abs(forward(joints) - poses).max()
    back = 0.0
    for one in range(8):
        there = ~np.isnan(solutions[:, one, 0])
        if there.any():
            back = max(back, np.abs(forward(solutions[there, one, :]) - poses[there]).max())
    ours_only, theirs_only = unmatched(solutions, theirs), unmatched(theirs, solutions)
    regular = ~singular
    wrong = int(((ours_only > 0) | (theirs_only > 0))[regular].sum())
    least = int((~np.isnan(solutions[:, :, 0])).sum(axis=1).min())
    ours, other = int((~np.isnan(solutions[regular, :, 0])).sum()), int((~np.isnan(theirs[regular, :, 0])).sum())
    print(
        f"{name:20} {len(joints)} poses, flange {difference:.1e}, at the solutions {back:.1e} m; {int(singular.sum())} near "
        f"a singular pose; of the others {ours} solutions here, {other} there, {wrong} poses with another set; "
        f"at least {least} solutions",
        flush=True,
    )
    return wrong + int(difference > 1e-9) + int(back > 1e-6) + int(least == 0)


def of_opw(binary, count):
    wrong = 0
    for seed, (name, (lengths, offsets, signs)) in enumerate(OPW.items()):
        words = [",".join(map(str, numbers)) for numbers in (lengths, offsets, signs)]
        joints, poses, solutions = records([binary, "opw", *words, str(count), str(seed)])
        model = opw.KinematicModel(*lengths, tuple(np.radians(offsets)), tuple(sign < 0 for sign in signs))
        robot = opw.Robot(model, degrees=False)

        def forward(angles):
            return robot.batch_forward(np.ascontiguousarray(angles)).as_matrix()

        theirs = robot.reach(RigidTransform.from_matrix(poses)).joints
        # What the angles of the convention are.
        angles = joints * signs - np.radians(offsets)
        a1, a2, b, c1, c2, c3, c4 = lengths
        elbow = np.abs(np.sin(angles[:, 2] + np.arctan2(a2, c3)))
        wrist = poses[:, :3, 3] - c4 * poses[:, :3, 2]
        out = np.hypot(wrist[:, 0], wrist[:, 1])
        shoulder = np.sqrt(np.maximum(out**2 - b**2, 0)) / (c2 + c3)
        singular = (np.abs(np.sin(angles[:, 4])) < SINGULAR) | (elbow < SINGULAR) | (shoulder < SINGULAR)
        # On the other side of the first axis the arm may be stretched.
        for side in (1, -1):
            ahead = side * shoulder * (c2 + c3) - a1
            distance = np.hypot(ahead, wrist[:, 2] - c1)
            forearm = np.hypot(a2, c3)
            for limit in (c2 + forearm, abs(c2 - forearm)):
                singular |= np.abs(distance - limit) < SINGULAR * (c2 + c3)
            # And of the wrist there, the fifth joint.
        solved = solutions * np.array(signs) - np.radians(offsets)
        with np.errstate(invalid="ignore"):
            singular |= (np.abs(np.sin(solved[:, :, 4])) < SINGULAR).any(axis=1)
        wrong += report(name, joints, poses, solutions, forward, theirs, singular)
    return wrong


def of_ur(binary, count):
    wrong = 0
    for seed, (name, lengths) in enumerate(UR.items()):
        joints, poses, solutions = records([binary, "ur", ",".join(map(str, lengths)), str(count), str(seed)])
        library = getattr(ur, name)

        def forward(angles):
            return np.array([library.forward_kinematics(*one) for one in angles])

        theirs = np.full((len(poses), 8, 6), np.nan)
        for number, pose in enumerate(poses):
            found = library.inverse_kinematics(pose)
            for one, angles in enumerate(found[:8]):
                theirs[number, one] = np.array(angles).reshape(6)
        d1, a2, a3, d4, d5, d6 = lengths
        wrist = poses[:, :3, 3] - d6 * poses[:, :3, 2]
        out = np.hypot(wrist[:, 0], wrist[:, 1])
        singular = np.abs(out - d4) < SINGULAR
        with np.errstate(invalid="ignore"):
            for joint in (2, 4):
                singular |= (np.abs(np.sin(solutions[:, :, joint])) < SINGULAR).any(axis=1)
        wrong += report(name, joints, poses, solutions, forward, theirs, singular)
    return wrong


if __name__ == "__main__":
    binary, total = sys.argv[1], int(sys.argv[2])
    wrong = of_opw(binary, total // len(OPW)) + of_ur(binary, total // len(UR))
    print("the same" if wrong == 0 else f"{wrong} differences")
    sys.exit(0 if wrong == 0 else 1)
