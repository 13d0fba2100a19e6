# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# flake8: noqa: F821 (Yade gives the names)
"""The column of cubes of scripts/compare-peers that collapses, in Yade, by the numbers of scene.json."""
import json
import time

from yade import polyhedra_utils

scene = json.load(open('scene.json'))
material = PolyhedraMat(density=scene['density'], young=scene['stiffness'], poisson=scene['shear'], frictionAngle=atan(scene['friction']))
O.materials.append(material)
half = scene['half']
corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
for centre, turn in scene['bodies']:
    cube = polyhedra_utils.polyhedra(material, v=corners)
    cube.state.pos = Vector3(*centre)
    cube.state.ori = Quaternion(*turn)
    O.bodies.append(cube)
O.bodies.append(wall(0, axis=2, sense=1, material=material))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb(), Bo1_Wall_Aabb()], verletDist=scene['skin']),
    InteractionLoop([Ig2_Wall_Polyhedra_PolyhedraGeom(), Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                    [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()], [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    NewtonIntegrator(damping=scene['damping'], gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
O.dt = scene['step']
start = time.process_time()
O.run(scene['steps'], True)
seconds = time.process_time() - start
cubes = [b.state for b in O.bodies if isinstance(b.shape, Polyhedra)]
json.dump({'seconds': seconds, 'bodies': [[*s.pos, *s.vel] for s in cubes]}, open('result.json.yade', 'w'))
