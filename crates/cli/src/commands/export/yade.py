
# Stiffness and damping are set at each step from the material, radius and mass of the two bodies in contact, because YADE
# uses half of the radius between a sphere and a wall.
from math import pi, sqrt

forces = []


def spheres(bodies):
    return [body for body in bodies if isinstance(body.shape, Sphere)]


def law():
    for contact in O.interactions:
        depth = contact.geom.penetrationDepth
        if depth > 0:
            bodies = [O.bodies[number] for number in (contact.id1, contact.id2)]
            radius = 1 / sum(1 / ball.shape.radius for ball in spheres(bodies))
            mass = 1 / sum(1 / ball.state.mass for ball in spheres(bodies))
            modulus, lag, beta = LAWS[tuple(sorted(body.material.label for body in bodies))]
            stiffness = 4 / 3 * modulus * sqrt(radius)
            contact.phys.kno = stiffness
            contact.phys.betan = beta or 2 * lag * modulus**2 * radius * depth / sqrt(1.5 * stiffness * mass * sqrt(depth))
    forces.append(O.forces.f(0).norm())


def shortest():
    """A lower bound in s of all contact times of the balls; it is proportional to the radius of the lightest."""
    balls = spheres(O.bodies)
    stiffest = max(modulus for modulus, _, _ in LAWS.values())
    speed = V + 2 * max(ball.state.vel.norm() for ball in balls)
    return HERTZ * (min(ball.state.mass**2 / ball.shape.radius for ball in balls) / (4 * stiffest**2 * speed)) ** 0.2


def check():
    steps = shortest() / O.dt
    if steps < LEAST:
        raise ValueError(f"{steps:.0f} steps over the shortest contact, fewer than {LEAST:.0f}: use a smaller O.dt")


MODULUS = LAWS["striker", "target"][0]  # for the first step of a contact
for name, number, (radius, mass) in zip(("striker", "target"), (1, -1), BALLS):
    density = mass / (4 / 3 * pi * radius**3)
    O.materials.append(FrictMat(young=MODULUS, poisson=0.3, frictionAngle=0, density=density, label=name))
    O.bodies.append(sphere((0, 0, number * radius), radius, material=name))
if len(BALLS) == 1:
    O.materials.append(FrictMat(young=MODULUS, poisson=0.3, frictionAngle=0, label="target"))
    O.bodies.append(wall(0, axis=2, material="target"))
O.bodies[0].state.vel = (0, 0, -V)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_MindlinPhys(betan=0, betas=0)],
        [Law2_ScGeom_MindlinPhys_Mindlin()],
    ),
    PyRunner(command="law()", iterPeriod=1),
    PyRunner(command="check()", iterPeriod=10),
    NewtonIntegrator(damping=0),
]
O.dt = shortest() / STEPS
O.run(int(1.25 * T / O.dt), wait=True)
print("restitution", (O.bodies[0].state.vel[2] - O.bodies[1].state.vel[2]) / V)
print(f"peak force {max(forces):.10g} N, contact time {O.dt * sum(force > 0 for force in forces):.6g} s")
