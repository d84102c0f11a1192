#!/usr/bin/env bash
# MuJoCo 4.0.0: a thin wire that friction holds slides all the same, at millimetres in a second.
#
# A wire pushed by less than mu times the force that presses it to the wall is thought to stick; contacts are soft,
# but then one expects it to give way by some distance and to stop. It does not stop: friction that is not used up is
# a damper, scaled by the mass of what it holds, and a wire weighs milligrams. 50 mm of a guidewire of 0.36 mm,
# pressed by 10 mN and pushed by half of what friction holds, go at 16 mm/s, as fast as a hand feeds it; at 1 mN still
# at 1.7 mm/s. The speed is in proportion to the load, so that it sticks at none, and a shorter time step changes
# nothing. While a wire is held for ten seconds, it backs out of a vessel by centimetres. Remedy: the elliptic cone
# with noslip_iterations, by which it stays, or with impratio, by which the speed is divided.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "mujoco==4.0.0"
cd "$work"
"$work/venv/bin/python" - <<'PY'
import mujoco

LENGTH, RADIUS, DENSITY, FRICTION = 0.05, 0.18e-3, 6450.0, 0.2


def speed(press, option="", time_step=1e-3, density=DENSITY):
    """How fast the wire goes after a second of a push by half of what friction holds [m/s]."""
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
      <option gravity="0 0 0" timestep="{time_step}" {option}/>
      <default><geom friction="{FRICTION} 0 0"/></default>
      <worldbody><geom type="plane" size="1 1 0.1"/><body pos="0 0 {RADIUS}"><freejoint/>
        <geom type="capsule" fromto="{-LENGTH / 2} 0 0 {LENGTH / 2} 0 0" size="{RADIUS}" density="{density}"/>
      </body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    data.xfrc_applied[1, 2] = -press
    for _ in range(round(1.0 / time_step)):
        mujoco.mj_step(model, data)
    data.xfrc_applied[1, 0] = 0.5 * FRICTION * press
    places = []
    for _ in range(2):
        for _ in range(round(1.0 / time_step)):
            mujoco.mj_step(model, data)
        places.append(data.qpos[0])
    assert data.ncon == 2
    return places[1] - places[0]


print("MuJoCo", mujoco.__version__)
usual = {}
for press in (1e-4, 1e-3, 1e-2):
    usual[press] = speed(press)
    print(f"pressed by {1e3 * press:4.1f} mN, pushed by half of mu N: {1e3 * usual[press]:8.4f} mm/s")
assert usual[1e-2] > 1e-2 and usual[1e-3] > 1e-3
assert 9.0 < usual[1e-2] / usual[1e-3] < 11.0 and 9.0 < usual[1e-3] / usual[1e-4] < 11.0
for name, least, most, option, time_step in (
    ("a quarter of the time step", 0.99, 1.01, "", 2.5e-4),
    ("elliptic cone", 0.6, 0.8, 'cone="elliptic"', 1e-3),
    ("elliptic cone, impratio 100", 0.006, 0.008, 'cone="elliptic" impratio="100"', 1e-3),
    ("elliptic cone, 10 noslip_iterations", -1e-6, 1e-6, 'cone="elliptic" noslip_iterations="10"', 1e-3),
):
    found = speed(1e-3, option=option, time_step=time_step)
    print(f"  at 1 mN, {name:36}: {1e3 * found:8.4f} mm/s")
    assert least < found / usual[1e-3] < most
heavy = speed(1e-3, density=10.0 * DENSITY)
print(f"  at 1 mN, {'ten times as heavy':36}: {1e3 * heavy:8.4f} mm/s")
assert 0.09 < heavy / usual[1e-3] < 0.11
print("As described: what is held creeps.")
PY
