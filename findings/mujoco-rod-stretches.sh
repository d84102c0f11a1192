#!/usr/bin/env bash
# MuJoCo 4.0.0: how far an elastic rod stretches hangs on its mass and mesh, not on its modulus.
#
# Its reference says that Young's modulus of a one-dimensional flex gives bending and torsion, and to
# hold the edges' lengths by edge equality. With that, one expects a rod that is nearly inextensible.
# But an equality is a spring with the mass of a node over the square of its time constant, 20 ms by
# default, and a thin wire's nodes weigh milligrams: a wire of 100 mm, 2 mm thick, E = 1 GPa, pulled by
# 0.1 N (10 grams of weight), should grow by 3 micrometres and grows by 1.3 m with 20 edges. The modulus
# changes nothing, a shorter time step nothing; a mesh twice as fine makes it four times as long.
# What is pushed shortens likewise, so that less wire is in a vessel than was fed. Remedy: look at the
# edges' lengths, and set the time constant or the stiffness by hand, with steps that are short enough.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "mujoco==4.0.0"
cd "$work"
"$work/venv/bin/python" - <<'PY'
import mujoco
import numpy as np

LENGTH, RADIUS, DENSITY, PULL = 0.1, 1e-3, 2000.0, 0.1


def stretched(edges, young, time_step):
    """How much longer the pulled rod is when it has settled [m]."""
    points = " ".join(f"{LENGTH / edges * i:.9g} 0 0" for i in range(edges + 1))
    pairs = " ".join(f"{i} {i + 1}" for i in range(edges))
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
      <option integrator="discrete" gravity="0 0 0" timestep="{time_step}"/>
      <worldbody><flexcomp name="rod" type="direct" dim="1" dof="full" radius="{RADIUS}"
        mass="{DENSITY * np.pi * RADIUS**2 * LENGTH}" point="{points}" element="{pairs}">
        <edge equality="true"/><contact selfcollide="none"/>
        <elasticity young="{young}" shear="{young / 2.6}"/><pin id="0 1"/>
      </flexcomp></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    tip = model.flex_vertbodyid[-1]
    for _ in range(round(4.0 / time_step)):
        data.xfrc_applied[tip, 0] = PULL
        data.qvel *= np.exp(-20.0 * time_step)  # so that it settles
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    assert abs(data.qvel).max() < 1e-3
    return data.flexvert_xpos[-1, 0] - LENGTH


print("MuJoCo", mujoco.__version__)
found = {}
for edges, young, time_step in ((10, 1e9, 1e-3), (20, 1e9, 1e-3), (20, 1e11, 1e-3), (20, 1e9, 2.5e-4)):
    found[edges, young, time_step] = longer = stretched(edges, young, time_step)
    exact = PULL * LENGTH / (young * np.pi * RADIUS**2)
    print(f"{edges} edges, E = {young:.0e} Pa, step {1e3 * time_step:.2f} ms: longer by {1e3 * longer:7.1f} mm;"
          f" F L/(E A) is {1e3 * exact:.5f} mm")
usual = found[20, 1e9, 1e-3]
assert usual > 10.0 * LENGTH, usual
assert abs(found[20, 1e11, 1e-3] / usual - 1.0) < 1e-3
assert abs(found[20, 1e9, 2.5e-4] / usual - 1.0) < 1e-3
assert 3.5 < usual / found[10, 1e9, 1e-3] < 4.5
print("As described: set by mass and mesh alone.")
PY
