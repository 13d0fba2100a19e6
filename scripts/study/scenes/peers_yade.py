# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# flake8: noqa: F821 (Yade gives the names)
"""The settled bed and the flat drop of scripts/compare-peers in Yade, by the numbers of scene.json."""
import json
import time

scene = json.load(open('scene.json'))
material = FrictMat(young=scene['youngs'], poisson=scene['poisson'], frictionAngle=atan(scene['friction']), density=scene['density'])
O.materials.append(material)
if scene['name'] == 'bed':
    O.periodic = True
    O.cell.setBox(scene['side'], scene['side'], 2 * scene['top'])
    floor = box(center=(scene['side'] / 2, scene['side'] / 2, scene['floor'] - 0.01), extents=(2 * scene['side'], 2 * scene['side'], 0.01), fixed=True)
else:
    floor = wall(scene['floor'], axis=2)
O.bodies.append(floor)
for centre, turn in scene['bodies']:
    at = Vector3(centre) + Vector3(0, 0, scene['floor'])
    q = Quaternion(*turn)
    spheres = [sphere(at + q * Vector3(x, y, z), r) for x, y, z, r in scene['spheres']]
    if len(spheres) == 1:
        O.bodies.append(spheres[0])
    else:
        O.bodies.appendClumped(spheres, discretization=10)
for b in O.bodies:
    if b.isClump or (b.isStandalone and isinstance(b.shape, Sphere)):
        b.state.vel = Vector3(0, 0, scene['velocity'])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb(), Bo1_Wall_Aabb()], allowBiggerThanPeriod=True, verletDist=scene['skin']),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=scene['restitution'], es=scene['restitution'])],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, scene['gravity'])),
]
O.dt = scene['step']
if scene['warm_up'] > 0:  # O.run(0) never ends
    O.run(scene['warm_up'], True)
start = time.process_time()
O.run(scene['steps'], True)
seconds = time.process_time() - start
moving = [b for b in O.bodies if b.isClump or (b.isStandalone and isinstance(b.shape, Sphere))]
json.dump({'seconds': seconds, 'vz': sum(b.state.vel[2] for b in moving) / len(moving)}, open('result.json.yade', 'w'))
