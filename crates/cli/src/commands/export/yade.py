
# YADE takes half of the radius between a sphere and a wall, so the stiffness is given at each step.
from math import sqrt

K = 4 / 3 * E_STAR * sqrt(R)


def law():
    for contact in O.interactions:
        depth = contact.geom.penetrationDepth
        if depth > 0:
            contact.phys.kno = K
            contact.phys.betan = BETA or 2 * LAG * E_STAR**2 * R * depth / sqrt(1.5 * K * M * sqrt(depth))


for number, (radius, mass) in enumerate(BALLS):
    density = mass / (4 / 3 * 3.141592653589793 * radius**3)
    material = FrictMat(young=E_STAR, poisson=0.3, frictionAngle=0, density=density)
    O.bodies.append(sphere((0, 0, -radius if number else radius), radius, material=material))
if len(BALLS) == 1:
    O.bodies.append(wall(0, axis=2, material=material))
O.bodies[0].state.vel = (0, 0, -V)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_MindlinPhys(betan=BETA, betas=0)],
        [Law2_ScGeom_MindlinPhys_Mindlin()],
    ),
    PyRunner(command="law()", iterPeriod=1),
    NewtonIntegrator(damping=0),
]
O.dt = STEP
O.run(5000, wait=True)
print("restitution", (O.bodies[0].state.vel[2] - O.bodies[1].state.vel[2]) / V)
