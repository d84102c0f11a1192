#!/usr/bin/env bash
# MuJoCo 4.0.0: how deep a wire sinks into a wall goes with the square of the coefficient of friction.
#
# A wall's softness is given by solref and solimp, and friction is thought to act along the wall only. But the usual
# cone of friction is a pyramid whose edges carry the normal force as well, and each of them is made as soft as
# friction has to be, by mu squared. A guidewire of 0.36 mm, 50 mm of it pressed by 1 mN, sinks by 0.8 um with a
# coefficient of 0.05, that of a coated wire, by 14 um with 0.2 and by 313 um with 0.8, nearly its whole thickness.
# With cone="elliptic" it is 488 um whatever the coefficient. So a study of friction is one of clearance, too, lumens
# grow with the roughness of their walls, and a shorter time step changes nothing. Remedy: the elliptic cone, and then
# solref and solimp for a depth that is small beside the clearance, under the load that is expected.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "mujoco==4.0.0"
cd "$work"
"$work/venv/bin/python" - <<'PY'
import mujoco

LENGTH, RADIUS, DENSITY, PRESS = 0.05, 0.18e-3, 6450.0, 1e-3


def depth(friction, option="", time_step=1e-3):
    """How deep the pressed wire lies in the wall when it has settled [m]."""
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
      <option gravity="0 0 0" timestep="{time_step}" {option}/>
      <default><geom friction="{friction} 0 0"/></default>
      <worldbody><geom type="plane" size="1 1 0.1"/><body pos="0 0 {RADIUS}"><freejoint/>
        <geom type="capsule" fromto="{-LENGTH / 2} 0 0 {LENGTH / 2} 0 0" size="{RADIUS}" density="{DENSITY}"/>
      </body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    data.xfrc_applied[1, 2] = -PRESS
    for _ in range(round(2.0 / time_step)):
        mujoco.mj_step(model, data)
    assert abs(data.qvel).max() < 1e-6 and data.ncon == 2
    return RADIUS - data.qpos[2]


print("MuJoCo", mujoco.__version__)
usual = {}
for friction in (0.05, 0.1, 0.2, 0.4, 0.8):
    usual[friction], elliptic = depth(friction), depth(friction, 'cone="elliptic"')
    print(f"coefficient {friction:4}: sinks by {1e6 * usual[friction]:6.1f} um, with an elliptic cone {1e6 * elliptic:.1f} um")
    assert abs(elliptic / 488.3e-6 - 1.0) < 1e-3
for friction in (0.05, 0.1, 0.2):
    assert 3.9 < usual[2.0 * friction] / usual[friction] < 4.6
assert usual[0.8] > 300.0 * usual[0.05] and usual[0.8] > 1.5 * RADIUS
fine = depth(0.2, time_step=2.5e-4)
print(f"coefficient  0.2, a quarter of the time step: {1e6 * fine:6.1f} um")
assert abs(fine / usual[0.2] - 1.0) < 1e-3
print("As described: by the square of the coefficient.")
PY
