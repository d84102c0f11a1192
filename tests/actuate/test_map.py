"""Measured maps: cubic fields exactly, files, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.io import netcdf_file

from magwire.actuate import FieldGrid, Helmholtz, Input, Map, Pair, Pose
from magwire.actuate.grids import read_grid
from magwire.errors import InputError

CURRENT = Input("I", "A")
FIRST, STEP, SHAPE = np.array([-0.02, -0.03, 0.01]), np.array([0.01, 0.012, 0.008]), (6, 5, 7)


def places() -> np.ndarray:
    axes = [f + s * np.arange(n) for f, s, n in zip(FIRST, STEP, SHAPE, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)


def cubic(x: np.ndarray) -> np.ndarray:
    """A field that is cubic in each coordinate."""
    a, b, c = (x[..., i] / 0.02 for i in range(3))
    return np.stack([a**3 + b * c, 1.0 + a * b**2 * c, c**3 - 2.0 * a * b], axis=-1)


def sampled() -> FieldGrid:
    return FieldGrid(FIRST, STEP, cubic(places()))


INSIDE = FIRST + STEP * (np.array(SHAPE) - 1) * np.array(
    [[0.0, 0.0, 0.0], [0.31, 0.77, 0.5], [0.99, 0.02, 0.6], [1.0, 1.0, 1.0]]
)


@pytest.mark.parametrize("pose", [Pose(), Pose.turned([1.0, -1.0, 2.0], 0.6, (0.1, 0.2, 0.0))])
def test_cubic_fields_are_met_exactly(pose: Pose) -> None:
    field = Map(fields=(sampled(),), controls=(CURRENT,), pose=pose)
    b, _ = field.at(INSIDE @ pose.matrix.T + pose.shift, [2.0])
    np.testing.assert_allclose(b, 2.0 * cubic(INSIDE) @ pose.matrix.T, atol=1e-12)


def test_there_is_no_field_outside() -> None:
    field = Map(fields=(sampled(),), controls=(CURRENT,))
    point = [[-0.03, 0.0, 0.03]]
    assert np.all(np.isnan(field.at(point, [1.0])[0]))
    assert field.outside(point) == pytest.approx([0.01])


def test_a_fine_map_of_coils() -> None:
    coils = Helmholtz(pairs=(Pair("z", 0.1, 100.0),))
    errors = []
    for n in (9, 17):
        axis = np.linspace(-0.04, 0.04, n)
        grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
        values = coils.at(grid.reshape(-1, 3), [1.0])[0].reshape(grid.shape)
        field = Map(
            fields=(FieldGrid(np.full(3, -0.04), np.full(3, 0.08 / (n - 1)), values),),
            controls=(CURRENT,),
        )
        points = np.array([[0.013, 0.021, -0.017], [-0.03, 0.011, 0.026]])
        off = field.at(points, [1.0])[0] - coils.at(points, [1.0])[0]
        errors.append(np.abs(off).max())
        divergence, curl = field.faults()
    assert errors[0] / errors[1] > 10.0  # of fourth order
    assert divergence < 0.02
    assert curl < 0.02


def write_csv(path: Path, grid: FieldGrid) -> None:
    rows = np.hstack([places().reshape(-1, 3), grid.values.reshape(-1, 3)])
    np.random.default_rng(0).shuffle(rows)
    np.savetxt(path, rows, delimiter=",", header="x,y,z,Bx,By,Bz", comments="", fmt="%.17g")


def write_netcdf(path: Path, grid: FieldGrid) -> None:
    with netcdf_file(path, "w") as file:
        for i, axis in enumerate("xyz"):
            file.createDimension(axis, SHAPE[i])
            file.createVariable(axis, "d", (axis,))[:] = FIRST[i] + STEP[i] * np.arange(SHAPE[i])
        for i, axis in enumerate("xyz"):
            variable = file.createVariable(f"B{axis}", "d", ("z", "y", "x"))
            variable[:] = grid.values[..., i].transpose(2, 1, 0)


def write_image(path: Path, grid: FieldGrid) -> None:
    numbers = " ".join(f"{v:.17g}" for v in grid.values.transpose(2, 1, 0, 3).ravel())
    extent = " ".join(f"0 {n - 1}" for n in SHAPE)
    origin, spacing = (" ".join(f"{v:.17g}" for v in a) for a in (FIRST, STEP))
    path.write_text(
        f'<?xml version="1.0"?><VTKFile type="ImageData"><ImageData WholeExtent="{extent}" '
        f'Origin="{origin}" Spacing="{spacing}"><Piece Extent="{extent}"><PointData>'
        f'<DataArray type="Float64" Name="B" NumberOfComponents="3" format="ascii">{numbers}'
        "</DataArray></PointData></Piece></ImageData></VTKFile>"
    )


@pytest.mark.parametrize(
    ("name", "write"), [("b.csv", write_csv), ("b.nc", write_netcdf), ("b.vti", write_image)]
)
def test_files(tmp_path: Path, name: str, write: object) -> None:
    grid = sampled()
    write(tmp_path / name, grid)  # type: ignore[operator]
    found = read_grid(tmp_path / name)
    np.testing.assert_allclose(found.values, grid.values, rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose(found.first, FIRST, atol=1e-15)
    np.testing.assert_allclose(found.step, STEP, rtol=1e-12)


def stored(grid: FieldGrid) -> xr.Dataset:
    axes = {a: FIRST[i] + STEP[i] * np.arange(SHAPE[i]) for i, a in enumerate("xyz")}
    flux = {f"B{a}": (("x", "y", "z"), grid.values[..., i]) for i, a in enumerate("xyz")}
    return xr.Dataset(flux, coords=axes)


def test_netcdf_as_xarray_writes_it(tmp_path: Path) -> None:
    """Version 4; and in numbers that stand for others, which nothing in the field would tell."""
    grid = sampled()
    data = stored(grid)
    data.to_netcdf(tmp_path / "b.nc", engine="h5netcdf")
    found = read_grid(tmp_path / "b.nc")
    assert np.array_equal(found.values, grid.values)
    np.testing.assert_allclose(found.step, STEP, rtol=1e-12)
    packed = {name: {"dtype": "float32", "scale_factor": 0.5} for name in ("Bx", "By", "Bz")}
    for engine, form in (("h5netcdf", None), ("scipy", "NETCDF3_CLASSIC")):
        data.to_netcdf(tmp_path / "p.nc", engine=engine, format=form, encoding=packed)  # type: ignore[call-overload]
        with pytest.raises(InputError, match="received some with a scale_factor"):
            read_grid(tmp_path / "p.nc")
    data.rename(x="u").to_netcdf(tmp_path / "u.nc", engine="h5netcdf")
    with pytest.raises(InputError, match="must be NetCDF with the variables x, y, z"):
        read_grid(tmp_path / "u.nc")


def test_an_image_as_vtk_writes_it(tmp_path: Path) -> None:
    """With the range of its norms inside of the array, and other arrays beside it."""
    vtk = pytest.importorskip("vtk")
    from vtk.util.numpy_support import numpy_to_vtk

    grid = sampled()
    image = vtk.vtkImageData()
    image.SetDimensions(*SHAPE)
    image.SetOrigin(*FIRST)
    image.SetSpacing(*STEP)
    flat = np.ascontiguousarray(grid.values.transpose(2, 1, 0, 3).reshape(-1, 3))
    for name, values in (("strength", np.linalg.norm(flat, axis=1)), ("B", flat)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        image.GetPointData().AddArray(array)
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetFileName(str(tmp_path / "b.vti"))
    writer.SetInputData(image)
    writer.Write()
    with pytest.raises(InputError, match="in ASCII: write it so, by SetDataModeToAscii"):
        read_grid(tmp_path / "b.vti")
    writer.SetDataModeToAscii()
    writer.Write()
    assert "<InformationKey" in (tmp_path / "b.vti").read_text()
    found = read_grid(tmp_path / "b.vti")
    np.testing.assert_allclose(found.values, grid.values, rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose(found.first, FIRST, atol=1e-15)


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("Spacing=", "Gaps=", "must have WholeExtent, Spacing and Origin that fit its array"),
        ('Spacing="', 'Spacing="-', "must have a positive Spacing; received [-0."),
        ("PointData", "CellData", "3 components over its points; received 0"),
        ('Components="3"', 'Components="1"', "3 components over its points; received 0"),
        ('format="ascii">', 'format="ascii">nan ', "that fit its array"),
        ('Origin="-0.02', 'Origin="nan', "must have finite numbers"),
        ("</DataArray>", "", "must be a VTK image"),
    ],
)
def test_faults_of_images(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    place = tmp_path / "b.vti"
    write_image(place, sampled())
    place.write_text(place.read_text().replace(old, new))
    with pytest.raises(InputError) as raised:
        read_grid(place)
    assert sentence in str(raised.value)
    assert "b.vti" in str(raised.value)


def test_a_map_in_millimetres_is_refused(tmp_path: Path) -> None:
    rows = np.hstack([1e3 * places().reshape(-1, 3), sampled().values.reshape(-1, 3)])
    head = {"header": "x,y,z,Bx,By,Bz", "comments": ""}
    np.savetxt(tmp_path / "b.csv", rows, delimiter=",", **head)
    with pytest.raises(
        InputError, match=r"b.csv' must be in metres; received one that is [\d. x]+ m"
    ):
        read_grid(tmp_path / "b.csv")


def test_inputs_of_a_map_have_names_of_their_own() -> None:
    with pytest.raises(InputError, match="must have names of their own; received I twice"):
        Map(fields=(sampled(), sampled()), controls=(CURRENT, CURRENT))


def test_a_turned_image_is_refused(tmp_path: Path) -> None:
    place = tmp_path / "b.vti"
    write_image(place, sampled())
    text = place.read_text()
    place.write_text(text.replace(" Spacing=", ' Direction="1 0 0 0 1 0 0 0 1" Spacing='))
    np.testing.assert_allclose(read_grid(place).first, FIRST, atol=1e-15)
    place.write_text(text.replace(" Spacing=", ' Direction="0 -1 0 1 0 0 0 0 1" Spacing='))
    with pytest.raises(InputError, match=r"axes along x, y and z.*received 0 -1 0 1 0 0 0 0 1"):
        read_grid(place)


@pytest.mark.parametrize(
    ("name", "text", "sentence"),
    [
        ("b.npy", "", "must be .csv, .nc or .vti; received .npy, which may hold a pickle"),
        ("b.pkl", "", "which may hold a pickle"),
        ("b.txt", "", "must be .csv, .nc or .vti; received '.txt'"),
        ("b.csv", "x,y,z,Bx,By\n", "lacks the column Bz"),
        ("b.csv", "x;y;z;Bx;By;Bz\n", "with commas between them; received 'x;y;z;Bx;By;Bz'"),
        ("b.csv", "", "with commas between them; received ''"),
        ("b.csv", "x,y,z,Bx,By,Bz\n", "must have a row for each point; received none"),
        ("b.csv", "x,y,z,Bx,By,Bz\n1,2,3,4,5,a\n", "numbers in every row"),
        (
            "b.csv",
            "x,y,z,Bx,By,Bz\n1,2,3,4,5,nan\n",
            "finite numbers in every row; received '1,2,3,4,5,nan'",
        ),
        ("b.csv", "x,y,z,Bx,By,Bz\n1,2,3,4,5,6\n", "more than one x"),
        (
            "b.csv",
            "x,y,z,Bx,By,Bz\n0,0,0,1,1,1\n1,1,1,1,1,1\n3,2,2,1,1,1\n",
            "x are not evenly spaced",
        ),
        ("b.csv", "x,y,z,Bx,By,Bz\n0,0,0,1,1,1\n1,1,1,1,1,1\n", "6 points have none"),
        ("b.nc", "nothing", "must be NetCDF with the variables x, y, z, Bx, By, Bz"),
        ("b.nc", "\x89HDF", "must be NetCDF with the variables x, y, z, Bx, By, Bz"),
        ("b.vti", "<VTKFile/>", "must be a VTK image"),
    ],
)
def test_faults(tmp_path: Path, name: str, text: str, sentence: str) -> None:
    (tmp_path / name).write_bytes(text.encode("latin-1"))
    with pytest.raises(InputError) as raised:
        read_grid(tmp_path / name)
    assert sentence in str(raised.value)
    assert "\n" not in str(raised.value)


def test_too_coarse_a_map_is_refused() -> None:
    with pytest.raises(InputError, match="at least 4 points along each axis; received 3 x 4 x 4"):
        FieldGrid(np.zeros(3), np.ones(3), np.zeros((3, 4, 4, 3)))
