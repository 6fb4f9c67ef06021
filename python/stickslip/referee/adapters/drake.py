"""Drake: a discrete multibody plant, contact by convex optimization (SAP, "lagged")."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Body, march

NAME = "Drake"
PURPOSE = "robots, their control and verification; contacts are compliant"
PACKAGE, MODULE = "drake", "pydrake.all"
COSTS = ("steps of 5 ms", "steps of 1 ms", "steps of 0.2 ms")
STEPS = (5e-3, 1e-3, 2e-4)


def solve(problem: Problem, cost: int) -> Answers:
    drake: Any = import_module(MODULE)
    return march(problem, STEPS[cost], lambda body: build(drake, body), stops=False)


def build(drake: Any, body: Body) -> Advance:
    builder = drake.DiagramBuilder()
    plant, _scene = drake.AddMultibodyPlantSceneGraph(builder, body.step)
    plant.set_discrete_contact_approximation(drake.DiscreteContactApproximation.kLagged)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
    plant.set_stiction_tolerance(1e-7)  # [m/s]; by default a block at rest creeps at 1e-3
    # A sphere that cannot turn: one contact.
    block = None
    parent = plant.world_body()
    for name, axis in (("x", [1, 0, 0]), ("y", [0, 1, 0]), ("z", [0, 0, 1])):
        mass = 1.0 if name == "z" else 0.0
        inertia = drake.UnitInertia.SolidSphere(0.05)
        block = plant.AddRigidBody(name, drake.SpatialInertia(mass, [0, 0, 0], inertia))
        joint = drake.PrismaticJoint(
            name, parent.body_frame(), block.body_frame(), axis, damping=0.0
        )
        plant.AddJoint(joint)
        parent = block
    surface = drake.ProximityProperties()
    friction = drake.CoulombFriction(body.mu, body.mu)
    drake.AddContactMaterial(
        dissipation=None, point_stiffness=1e9, friction=friction, properties=surface
    )
    surface.AddProperty("material", "relaxation_time", 0.0)
    up = drake.RigidTransform([0, 0, 0])
    plant.RegisterCollisionGeometry(plant.world_body(), up, drake.HalfSpace(), "ground", surface)
    plant.RegisterCollisionGeometry(
        block, drake.RigidTransform([0, 0, 0.05]), drake.Sphere(0.05), "block", surface
    )
    plant.Finalize()
    diagram = builder.Build()
    simulator = drake.Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    x, y, vx, vy = body.start
    plant.SetPositionsAndVelocities(context, [x, y, 0, vx, vy, 0])
    port = plant.get_applied_generalized_force_input_port()
    source = port.FixValue(context, [0.0, 0.0, 0.0])
    simulator.Initialize()
    count = 0

    def advance(fx: float, fy: float, fz: float) -> tuple[float, float, float, float]:
        nonlocal count
        count += 1
        source.GetMutableData().get_mutable_value().SetFromVector([fx, fy, fz])
        simulator.AdvanceTo(count * body.step)
        x, y, _, vx, vy, _ = plant.GetPositionsAndVelocities(context)
        return float(x), float(y), float(vx), float(vy)

    return advance
