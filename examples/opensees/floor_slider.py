"""A block on a floor of a structure in OpenSeesPy, which steps the structure while stickslip steps
the block.

    python examples/opensees/floor_slider.py [RECORD] [--mu 0.2] [--dt 0.005]

The coupling is one way: the block does not act back on the structure, so its mass must be small
beside that of the floor. Without a record file the example uses Kobe 1995, from the package
pyslammer.
"""

import argparse

import openseespy.opensees as ops
import stickslip as ss


def frame(quake, period=0.5, damping_ratio=0.05):
    """One story under uniform excitation in OpenSees: nodes 1 (fixed) and 2 (the floor)."""
    wn, mass = 2 * 3.141592653589793 / period, 1e5  # [rad/s], [kg]
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0, "-mass", mass)
    ops.fix(1, 1)
    ops.uniaxialMaterial("Elastic", 1, mass * wn**2)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    ops.rayleigh(2 * damping_ratio * wn, 0.0, 0.0, 0.0)
    ops.timeSeries("Path", 1, "-dt", quake.dt, "-values", *quake.acceleration, "-useLast")
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.algorithm("Linear")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def follow(slider, node, dof, ground, dt, steps):
    """Run the analysis of OpenSees, and a slider on the floor of a node in step with it.

    Parameters
    ----------
    slider : Slider or friction law
    node, dof : int
        Node of the floor, and its degree of freedom in the direction of the slider, from 1.
    ground : callable
        Ground acceleration by time [m/s^2], which OpenSees leaves out of the accelerations of nodes
        under uniform excitation; elsewhere `lambda time: 0.0`.
    dt : float
        Time step [s].
    steps : int

    Returns
    -------
    list of (float, float, State)
        Time, absolute acceleration of the floor and state of the slider, from the start on.
    """
    time, state = ops.getTime(), ss.State()
    floor = ops.nodeAccel(node, dof) + ground(time)
    history = [(time, floor, state)]
    for _ in range(steps):
        if ops.analyze(1, dt) != 0:
            raise RuntimeError(f"OpenSees does not converge after {time} s")
        before, start = time, floor
        time = ops.getTime()
        floor = ops.nodeAccel(node, dof) + ground(time)
        state = ss.advance(slider, state, time - before, start, floor)
        history.append((time, floor, state))
    return history


if __name__ == "__main__":
    import numpy as np

    ask = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    ask.add_argument("record", nargs="?", help="a file of any format that read_record knows")
    ask.add_argument("--mu", type=float, default=0.2, help="coefficient of friction [-]")
    ask.add_argument("--dt", type=float, default=0.005, help="time step [s]")
    args = ask.parse_args()

    quake = ss.read_record(args.record) if args.record else ss.sample_record("Kobe")
    frame(quake)

    def ground(time):
        return float(np.interp(time, quake.time, quake.acceleration))

    steps = round(quake.duration / args.dt)
    history = follow(ss.Coulomb(mu=args.mu), 2, 1, ground, args.dt, steps)
    slides = [state.displacement for _, _, state in history]
    print(f"largest acceleration of the floor   {max(abs(a) for _, a, _ in history):8.2f} m/s^2")
    print(f"peak displacement of the block      {100 * max(map(abs, slides)):8.2f} cm")
    print(f"residual displacement of the block  {100 * slides[-1]:8.2f} cm")
