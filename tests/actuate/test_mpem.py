"""Calibrated electromagnets against mag-manip, and their files' faults."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from magwire.actuate import MPEM, Held
from magwire.actuate.curve import Curve
from magwire.errors import InputError
from magwire.kernels.sources.table import ATAN, ERF, LINEAR, RATIONAL, TANH

from .handed import FOLDER, needs_files

SLOPES = ("dBx_dx", "dBx_dy", "dBx_dz", "dBy_dy", "dBy_dz_T_per_m_per_A")


@needs_files
def test_as_mag_manip() -> None:
    with (FOLDER / "reference_fields_mag_manip_3.0.0.csv").open() as file:
        rows = list(csv.DictReader(file))
    systems = {name: MPEM.read(FOLDER / name) for name in {row["file"] for row in rows}}
    for row in rows:
        system = systems[row["file"]]
        u = np.eye(len(system.inputs))[int(row["coil"])]
        b, g = system.at([[float(row[f"{c}_m"]) for c in "xyz"]], u)
        expected = np.array([float(row[f"B{c}_T_per_A"]) for c in "xyz"])
        assert np.abs(b[0] - expected).max() < 1e-8 * np.abs(expected).max()
        slopes = np.array([float(row[key]) for key in SLOPES])
        found = g[0][[0, 0, 0, 1, 1], [0, 1, 2, 1, 2]]
        assert np.abs(found - slopes).max() < 1e-8 * np.abs(slopes).max()


@needs_files
def test_iron_cores_saturate() -> None:
    calibration = FOLDER / "cardiomag_2019_calibration.yaml"
    system = MPEM.read(calibration, saturation=FOLDER / "cardiomag_2019_saturation.yaml")
    linear = MPEM.read(calibration)
    point = [[0.0, 0.0, 0.1]]
    full = np.ones(8)
    half, whole = (system.at(point, amperes * full)[0][0] for amperes in (17.0, 34.0))
    assert 1.2 < np.linalg.norm(whole) / np.linalg.norm(half) < 1.3
    little = 1e-3 * full  # the slope at zero is that of the linear calibration, within 2 percent
    now, then = system.at(point, little)[0], linear.at(point, little)[0]
    np.testing.assert_allclose(now, then, atol=0.02 * np.abs(then).max())


@pytest.mark.parametrize("kind", [LINEAR, ERF, ATAN, TANH, RATIONAL])
@pytest.mark.parametrize("u", [-12.0, 0.5, 20.0])
def test_a_curve_and_its_inverse_and_how_the_square_of_the_input_bends(kind: int, u: float) -> None:
    curve = Curve(kind, 18.0, 0.05 if kind != RATIONAL else 20.0)
    s = curve.strength(u)
    assert curve.input(s) == pytest.approx(u, rel=1e-9)
    step = 1e-3
    ends = [0.5 * curve.input(s + n * step) ** 2 for n in (-1.0, 0.0, 1.0)]
    bend = (ends[0] - 2.0 * ends[1] + ends[2]) / step**2
    assert curve.steepening(u) == pytest.approx(bend * curve.slope(u) ** 2, rel=1e-4)
    assert kind == LINEAR or abs(curve.input(-1e9)) < np.inf


@needs_files
def test_limits_of_navion() -> None:
    system = MPEM.read(FOLDER / "navion_2_calibration.yaml", limits=FOLDER / "navion_2_limits.yaml")
    assert [(i.low, i.high, i.resistance) for i in system.inputs] == [(-35.0, 35.0, 7.5)] * 3
    assert system.power([35.0, 35.0, 35.0]) == pytest.approx(27562.5)
    assert system.violations([35.0, -35.0, 0.0]) == ()
    assert system.violations([36.0, 0.0, 0.0]) == (
        "Input Coil_0 must be between -35 and 35 A; received 36 A.",
    )
    assert system.outside([[0.0, 0.0, 0.0], [0.111, 0.0, 0.0]]) == pytest.approx([0.0, 0.01])


CALIBRATION = """\
# one coil of two sources
Coil_List:
- Coil_0
Coil_0:
  Source_List: [Src_0, Src_1]
  Src_0:
    A_Coeff: ~
    B_Coeff: [1.0e-4]
    Source_Direction: [0.0, 0.0, 1.0000000005]
    Source_Position:
      - 0.0
      - 0.0
      - 0.1
  Src_1:
    A_Coeff: [1e-3]
    B_Coeff: [1e-5, 2e-7]
    Source_Direction: [1.0, 0.0, 0.0]
    Source_Position: [0.0, 0.2, 0.0]
System_Name: "two sources"
Workspace_Dimensions:
  - [-0.05, 0.05]
  -
    - -0.05
    - 0.05
  - - -0.02
    - 0.05
"""
OFFSET = """\
Offset:
  Source_List: [Src_0]
  Src_0:
    A_Coeff: [2e-3]
    B_Coeff: ~
    Source_Direction: [1.0, 0.0, 0.0]
    Source_Position: [0.0, 0.0, 0.0]
"""
LIMITS = """\
system_name: two sources
num_electromagnets: 1
max_currents: [10]
coil_resistances: [2.0]
max_power: 100
"""
SATURATION = """\
saturation_functions:
  coil_0:
    type: erf
    params: [10.0, 0.1]
"""


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text)
    return path


def test_sources_of_higher_order(tmp_path: Path) -> None:
    """Against the potential in the words of the format, by differences."""
    system = MPEM.read(write(tmp_path, "c.yaml", CALIBRATION))

    def potential(x: np.ndarray) -> float:
        total = 0.0
        for place, axis, b, a in (
            ([0.0, 0.0, 0.1], [0.0, 0.0, 1.0], [1e-4], []),
            ([0.0, 0.2, 0.0], [1.0, 0.0, 0.0], [1e-5, 2e-7], [1e-3]),
        ):
            r = x - np.array(place)
            size = np.linalg.norm(r)
            c = r @ np.array(axis) / size
            legendre = {1: c, 2: 1.5 * c * c - 0.5}
            total += sum(v * size ** (-n - 1) * legendre[n] for n, v in enumerate(b, 1))
            total += sum(v * size**n * legendre[n] for n, v in enumerate(a, 1))
        return total

    x, h = np.array([0.02, -0.01, 0.03]), 1e-4
    slope = [
        (8.0 * (potential(x + e) - potential(x - e)) - potential(x + 2 * e) + potential(x - 2 * e))
        / (12.0 * h)
        for e in h * np.eye(3)
    ]
    b, _ = system.at([x], [3.0])
    np.testing.assert_allclose(b[0], -3.0 * np.array(slope), rtol=1e-8)


def test_braces_say_the_same_as_lines(tmp_path: Path) -> None:
    """Numbers such as 1e-05 included, which YAML 1.1 takes for texts."""
    braces = """{Coil_List: [Coil_0], Coil_0: {Source_List: [Src_0, Src_1],
      Src_0: {A_Coeff: , B_Coeff: [1e-04], Source_Position: [0, 0, 1e-1],
        Source_Direction: [0.0, 0.0, 1.0000000005]},
      Src_1: {A_Coeff: [1e-3], B_Coeff: [1e-05, 2E-7], Source_Position: [0.0, 0.2, 0.0],
        Source_Direction: [1.0, 0.0, 0.0]}}, System_Name: 'two sources',
      Workspace_Dimensions: [[-0.05, 0.05], [-0.05, 0.05], [-0.02, 0.05]]}"""
    lines = MPEM.read(write(tmp_path, "lines.yaml", CALIBRATION))
    assert MPEM.read(write(tmp_path, "braces.yaml", braces)).calibration == lines.calibration


def test_an_offset_is_a_constant_and_no_coil(tmp_path: Path) -> None:
    bare = MPEM.read(write(tmp_path, "a.yaml", CALIBRATION))
    with_offset = MPEM.read(write(tmp_path, "b.yaml", CALIBRATION + OFFSET))
    assert len(with_offset.inputs) == 1
    point = [[0.01, 0.0, 0.0]]
    for amperes in (0.0, 4.0):
        more = with_offset.at(point, [amperes])[0] - bare.at(point, [amperes])[0]
        np.testing.assert_allclose(more, [[-2e-3, 0.0, 0.0]], atol=1e-15)
    listed = CALIBRATION.replace("- Coil_0\nCoil_0", "- Coil_0\n- Offset\nCoil_0") + OFFSET
    same = MPEM.read(write(tmp_path, "c.yaml", listed))
    assert [i.name for i in same.inputs] == ["Coil_0"]
    np.testing.assert_array_equal(same.at(point, [4.0])[0], with_offset.at(point, [4.0])[0])


def test_saturation_is_held_too(tmp_path: Path) -> None:
    system = MPEM.read(
        write(tmp_path, "c.yaml", CALIBRATION), saturation=write(tmp_path, "s.yaml", SATURATION)
    )
    held = Held(actuator=system, values=(12.0,))
    np.testing.assert_allclose(
        held.at([[0.0, 0.0, 0.0]], [])[0], system.at([[0.0, 0.0, 0.0]], [12.0])[0], rtol=1e-15
    )


def faulty(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new, 1)


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("Coil_List:\n- Coil_0\n", "", "lacks the key Coil_List"),
        ("    B_Coeff: [1.0e-4]\n", "", "lacks the key B_Coeff of Coil_0: Src_0"),
        ("    A_Coeff: ~\n", "", "lacks the key A_Coeff of Coil_0: Src_0"),
        ("System_Name", "Name", "lacks the key System_Name"),
        ("[Src_0, Src_1]", "[Src_0, Src_2]", "lacks the key Src_2 of Coil_0"),
        ("- Coil_0\n", "- Coil_0\n- Coil_1\n", "lacks the key Coil_1"),
        ("- Coil_0\n", "- Coil_0\n- Coil_0\n", "must not name an entry of Coil_List twice"),
        (
            "[0.0, 0.2, 0.0]",
            "[0.0, 0.2]",
            "must have 3 numbers in Coil_0: Src_1: Source_Position; received 2",
        ),
        (
            "[1.0e-4]",
            "[.nan]",
            "must have finite numbers in Coil_0: Src_0: B_Coeff; received nan",
        ),
        (
            "[1.0, 0.0, 0.0]",
            "[0.0, 0.0, 0.0]",
            "must have a direction of length 1 in Coil_0: Src_1: Source_Direction; "
            "received length 0",
        ),
        ("[1.0, 0.0, 0.0]", "[1.1, 0.0, 0.0]", "received length 1.1"),
        (
            "[-0.05, 0.05]",
            "[0.05, -0.05]",
            "must have the lower end first in Workspace_Dimensions: x; received 0.05 and -0.05",
        ),
        ("[1e-3]", "[one]", "must have finite numbers in Coil_0: Src_1: A_Coeff; received 'one'"),
        ("Src_1]\n", "Src_1\n", "cannot be read: line 6: expected ',' or ']', but got"),
        ("  Src_1:\n", "  Src_0:\n", "line 14 gives 'Src_0' a second time"),
        ("  Src_1:\n", "\tSrc_1:\n", "line 14: found character '\\t' that cannot start any token"),
        ("  Src_1:\n", "  Src_1: &a\n", "line 14 uses an anchor, which is not read"),
        (
            "  Src_1:\n",
            "  Src_1: !!set\n",
            "line 14 uses the tag tag:yaml.org,2002:set, which is not",
        ),
        ("System_Name", "---\nSystem_Name", "line 19 begins a second document"),
        ('"two sources"', "[" * 20, "line 19 is nested more than 16 deep"),
        (CALIBRATION, "", "must be a mapping of keys; received no key"),
    ],
)
def test_faults_of_calibrations(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    path = write(tmp_path, "c.yaml", faulty(CALIBRATION, old, new))
    with pytest.raises(InputError, match=re.escape(sentence)) as raised:
        MPEM.read(path)
    assert "\n" not in str(raised.value)
    assert str(raised.value).startswith(f"Calibration file '{path}' ")
    assert str(raised.value).endswith(".")


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("[10]", "[]", "must have 1 numbers in max_currents; received 0"),
        ("[10]", "[-10]", "must have positive numbers in max_currents; received -10"),
        (
            "electromagnets: 1",
            "electromagnets: 3",
            "must be for the 1 coils of the calibration; received 3",
        ),
        ("max_power: 100\n", "", "lacks the key max_power"),
        ("100", "0", "must have a positive number in max_power; received 0"),
    ],
)
def test_faults_of_limits(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    path = write(tmp_path, "l.yaml", faulty(LIMITS, old, new))
    with pytest.raises(InputError, match=re.escape(f"Limits file '{path}' {sentence}.")):
        MPEM.read(write(tmp_path, "c.yaml", CALIBRATION), limits=path)


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        (
            "erf",
            "sigmoid",
            "must have erf, atan, tanh, rational in saturation_functions: coil_0: type; "
            "received 'sigmoid'",
        ),
        (
            "[10.0, 0.1]",
            "[10.0]",
            "must have 2 numbers in saturation_functions: coil_0: params; received 1",
        ),
        ("saturation_functions", "functions", "lacks the key saturation_functions"),
        (
            SATURATION,
            SATURATION + "  coil_1:\n    type: erf\n    params: [1.0, 1.0]\n",
            "must have curves for 1 coils; received 2",
        ),
    ],
)
def test_faults_of_saturation(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    path = write(tmp_path, "s.yaml", faulty(SATURATION, old, new))
    with pytest.raises(InputError, match=re.escape(f"Saturation file '{path}' {sentence}.")):
        MPEM.read(write(tmp_path, "c.yaml", CALIBRATION), saturation=path)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        MPEM.read(tmp_path / "none.yaml")


def test_as_many_limits_as_coils(tmp_path: Path) -> None:
    calibration = MPEM.read(write(tmp_path, "c.yaml", CALIBRATION)).calibration
    with pytest.raises(InputError, match="one entry for each of 1 coils; received 2"):
        MPEM(calibration=calibration, max_currents=(1.0, 2.0))


@needs_files
def test_octomag_is_too_even_for_the_choice_of_a_field_to_save_a_fifth() -> None:
    """Along the tip it is free to choose: at most ((q - 1)/(q + 1))^2 of the power is saved.

    Where the small sinusoid of the campaign is; in the corners of the box it is a little more.
    """
    octomag = MPEM.read(FOLDER / "octomag_calibration.yaml")
    rng = np.random.default_rng(5)
    for point in rng.uniform((-8e-3, -3e-3, 0.0), (8e-3, 3e-3, 0.0), (20, 3)):
        by_current = octomag.response(point[None], np.zeros(8))[0][0].T
        costs = np.linalg.inv(by_current @ by_current.T)
        values = np.linalg.eigvalsh(costs)
        bound = ((values[-1] - values[0]) / (values[-1] + values[0])) ** 2
        for _ in range(50):
            along, across = np.linalg.qr(rng.normal(size=(3, 2)))[0].T
            best = across - along * (along @ costs @ across) / (along @ costs @ along)
            saved = 1.0 - (best @ costs @ best) / (across @ costs @ across)
            assert saved <= bound + 1e-12
        assert bound < 0.17
