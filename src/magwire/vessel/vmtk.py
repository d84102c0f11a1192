"""Centrelines of a surface by VMTK, where it is installed (Antiga et al. 2008).

VMTK follows the Voronoi diagram of the surface's points. They have to be dense, so triangles are
cut in four until they are small beside the narrowest end; and they must not lie on a perfect
cylinder, where the diagram degenerates and lines leap from end to end, so they are moved a little.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np

from magwire.vessel.files.drawing import Array, Line
from magwire.vessel.mesh import End, Shell

EDGE = 0.25  # mean edge of the triangles, over the radius of the narrowest end, at most
MOVED = 1e-4  # standard deviation of what points are moved by, over that edge
MOST = 200_000  # triangles
RADIUS = "MaximumInscribedSphereRadius"


def installed() -> bool:
    """Whether VMTK is there."""
    return find_spec("vmtk") is not None


def centrelines(hull: Shell, ends: list[End], first: int) -> tuple[Line, ...] | None:
    """Lines from the first end to each other one, in their order; None if VMTK finds fewer."""
    import vtk
    from vmtk import vtkvmtk
    from vtkmodules.util.numpy_support import vtk_to_numpy

    vtk.vtkObject.GlobalWarningDisplayOff()
    capper = vtkvmtk.vtkvmtkCapPolyData()
    capper.SetInputData(_wall(hull, EDGE * min(end.radius for end in ends)))
    capper.Update()
    caps = capper.GetCapCenterIds()
    numbers = [caps.GetId(k) for k in range(caps.GetNumberOfIds())]
    if len(numbers) < len(ends):
        return None
    centres = np.array([capper.GetOutput().GetPoint(k) for k in numbers])
    seeds, targets = vtk.vtkIdList(), vtk.vtkIdList()
    for k, end in enumerate(ends):
        nearest = int(np.argmin(np.linalg.norm(centres - end.centre, axis=1)))
        (seeds if k == first else targets).InsertNextId(nearest)
    finder = vtkvmtk.vtkvmtkPolyDataCenterlines()
    finder.SetInputConnection(capper.GetOutputPort())
    finder.SetCapCenterIds(caps)
    finder.SetSourceSeedIds(seeds)
    finder.SetTargetSeedIds(targets)
    finder.SetRadiusArrayName(RADIUS)
    finder.SetCostFunction("1/R")
    finder.SetAppendEndPointsToCenterlines(1)
    finder.Update()
    found = finder.GetOutput()
    if found.GetNumberOfCells() != len(ends) - 1:
        return None
    points = vtk_to_numpy(found.GetPoints().GetData()).astype(np.float64)
    radius = vtk_to_numpy(found.GetPointData().GetArray(RADIUS)).astype(np.float64)
    others = [end for k, end in enumerate(ends) if k != first]
    return tuple(
        _line(points, radius, found.GetCell(i), (ends[first], end)) for i, end in enumerate(others)
    )


def _wall(hull: Shell, edge: float) -> Any:
    """The wall with triangles of about that edge, open at its ends."""
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

    used, corners = np.unique(hull.wall, return_inverse=True)
    moved = MOVED * edge * np.random.default_rng(0).normal(size=(len(used), 3))
    places, cells, wall = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    places.SetData(numpy_to_vtk(hull.points[used] + moved, deep=True))
    cells.SetData(3, numpy_to_vtkIdTypeArray(corners.ravel().astype(np.int64), deep=True))
    wall.SetPoints(places)
    wall.SetPolys(cells)
    sides = hull.points[hull.wall] - hull.points[np.roll(hull.wall, 1, axis=1)]
    mean, count, cuts = float(np.linalg.norm(sides, axis=2).mean()), len(hull.wall), 0
    while mean > edge and 4 * count <= MOST:
        mean, count, cuts = 0.5 * mean, 4 * count, cuts + 1
    if cuts == 0:
        return wall
    cutter = vtk.vtkLinearSubdivisionFilter()
    cutter.SetInputData(wall)
    cutter.SetNumberOfSubdivisions(cuts)
    cutter.Update()
    return cutter.GetOutput()


def _line(points: Array, radius: Array, cell: Any, ends: tuple[End, End]) -> Line:
    """One line of the output, from the middle of its first end to that of its last."""
    ids = np.array([cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())])
    away = np.linalg.norm(points[ids[[0, -1]]] - ends[0].centre, axis=1)
    ids = ids if away[0] <= away[1] else ids[::-1]
    way = points[ids]
    way[0], way[-1] = ends[0].centre, ends[1].centre
    return Line("", way, radius[ids])
