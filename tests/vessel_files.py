"""A small vessel, in every format that magwire reads, as other programs write it."""

from __future__ import annotations

import base64
import json
import struct
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Lines = list[tuple[Array, Array]]

STEP = 0.5


def fork(turn: float = 1.0) -> Lines:
    """Two lines in mm that share a trunk of 30 mm, from the entrance to the ends."""
    s = np.arange(0.0, 60.0 + STEP, STEP)
    past = np.maximum(s - 30.0, 0.0)
    lines = []
    for side in (1.0, -1.0):
        y = side * turn * (20.0 * (1.0 - np.cos(past / 40.0)))
        points = np.column_stack([s, y, 0.1 * s])
        radius = 3.0 - 1.2 * np.clip((s - 20.0) / 40.0, 0.0, 1.0)
        lines.append((points, radius))
    return lines


def pieces() -> Lines:
    """The same vessel in three lines that meet at the fork."""
    (up, wide), (down, _) = fork()
    k = int(30.0 / STEP)
    return [(up[: k + 1], wide[: k + 1]), (up[k:], wide[k:]), (down[k:][::-1], wide[k:][::-1])]


def _packed(values: NDArray[Any], style: str, appended: list[bytes]) -> str:
    """Attributes and text of a data array."""
    data = values.tobytes()
    if style == "ascii":
        return 'format="ascii">' + " ".join(map(repr, values.ravel().tolist()))
    zipped = "zlib" in style
    if zipped:
        size = 1000
        parts = [data[i : i + size] for i in range(0, len(data), size)]
        blocks = [zlib.compress(part) for part in parts]
        last = len(parts[-1]) % size if parts else 0
        head = struct.pack(f"<{3 + len(blocks)}I", len(blocks), size, last, *map(len, blocks))
        body = b"".join(blocks)
    else:
        head, body = struct.pack("<I", len(data)), data
    if style.startswith("raw"):
        offset = sum(map(len, appended))
        appended.append(head + body)
        return f'format="appended" offset="{offset}">'
    encoded = base64.b64encode(head) + base64.b64encode(body) if zipped else b""
    encoded = encoded or base64.b64encode(head + body)
    if style.startswith("base64"):
        offset = sum(map(len, appended))
        appended.append(encoded)
        return f'format="appended" offset="{offset}">'
    return 'format="binary">' + encoded.decode()


def vtp(style: str = "ascii", lines: Lines | None = None, name: str = "Radius") -> bytes:
    """VTK XML PolyData; the style is ascii, binary, zlib, raw, raw-zlib, base64 or base64-zlib."""
    lines = fork() if lines is None else lines
    appended: list[bytes] = []
    points = np.concatenate([p for p, _ in lines]).astype(np.float32)
    radius = np.concatenate([r for _, r in lines])
    offsets = np.cumsum([len(r) for _, r in lines])

    def array(values: NDArray[Any], kind: str, more: str) -> str:
        packed = _packed(values, style, appended)
        return f'<DataArray type="{kind}" {more} {packed}</DataArray>'

    compressor = ' compressor="vtkZLibDataCompressor"' if "zlib" in style else ""
    text = (
        f'<?xml version="1.0"?><VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"'
        f' header_type="UInt32"{compressor}><PolyData><Piece NumberOfPoints="{len(points)}" '
        f'NumberOfLines="{len(lines)}"><PointData>'
        + array(radius, "Float64", f'Name="{name}"')
        + "</PointData><Points>"
        + array(points, "Float32", 'Name="Points" NumberOfComponents="3"')
        + "</Points><Lines>"
        + array(np.arange(len(points)), "Int64", 'Name="connectivity"')
        + array(offsets, "Int64", 'Name="offsets"')
        + "</Lines></Piece></PolyData>"
    )
    if not appended:
        return (text + "</VTKFile>").encode()
    encoding = "raw" if style.startswith("raw") else "base64"
    head = f'{text}<AppendedData encoding="{encoding}">_'.encode()
    return head + b"".join(appended) + b"</AppendedData></VTKFile>"


def vtk(style: str = "ascii") -> bytes:
    """Legacy VTK; the style is ascii, binary or five (version 5, as text)."""
    lines = fork()
    points = np.concatenate([p for p, _ in lines])
    radius = np.concatenate([r for _, r in lines])
    binary = style == "binary"

    def numbers(values: NDArray[Any], kind: str) -> bytes:
        if binary:
            return values.astype(kind).tobytes() + b"\n"
        return (
            "\n".join(" ".join(map(repr, row)) for row in np.atleast_2d(values).tolist()).encode()
            + b"\n"
        )

    out = b"# vtk DataFile Version 4.2\nvessel\n" + (b"BINARY\n" if binary else b"ASCII\n")
    out += f"DATASET POLYDATA\nPOINTS {len(points)} double\n".encode() + numbers(points, ">f8")
    counts = [len(r) for _, r in lines]
    if style == "five":
        stops = np.concatenate([[0], np.cumsum(counts)])
        out += f"LINES {len(stops)} {len(points)}\nOFFSETS vtktypeint64\n".encode()
        out += numbers(stops, ">i8") + b"CONNECTIVITY vtktypeint64\n"
        out += numbers(np.arange(len(points)), ">i8")
    else:
        first, cells = 0, []
        for count in counts:
            cells += [count, *range(first, first + count)]
            first += count
        out += f"LINES {len(lines)} {len(cells)}\n".encode() + numbers(np.array(cells), ">i4")
    out += f"POINT_DATA {len(points)}\nSCALARS radii double\nLOOKUP_TABLE default\n".encode()
    out += numbers(radius, ">f8")
    out += f"METADATA\nINFORMATION 0\n\nFIELD FieldData 1\nGroup 1 {len(points)} int\n".encode()
    return out + numbers(np.zeros(len(points), dtype=int), ">i4")


def table(mark: str = ",") -> bytes:
    """A table with a column for the line."""
    rows = [mark.join(("X", "Y", "Z", "MaximumInscribedSphereRadius", "line"))]
    for i, (points, radius) in enumerate(fork()):
        rows += [
            mark.join(map(repr, (*p, r))) + f"{mark}way{i}"
            for p, r in zip(points.tolist(), radius.tolist(), strict=True)
        ]
    return "\n".join(rows).encode()


def swc() -> bytes:
    """Points with parents; the trunk is there once."""
    (up, wide), (down, _) = fork()
    k = int(30.0 / STEP)
    rows = ["# made by hand"]
    for i, (p, r) in enumerate(zip(up, wide, strict=True)):
        rows.append(f"{i + 1} 0 {p[0]} {p[1]} {p[2]} {r} {i if i else -1}")
    for i in range(k + 1, len(down)):
        p, parent = down[i], k + 1 if i == k + 1 else len(up) + i - k - 1
        rows.append(f"{len(up) + i - k} 0 {p[0]} {p[1]} {p[2]} {wide[i]} {parent}")
    return "\n".join(rows).encode()


def pth() -> bytes:
    """A SimVascular path, in cm, with its two elements at the top."""
    points = 0.1 * fork()[0][0]
    rows = "".join(
        f'<path_point id="{i}"><pos x="{x}" y="{y}" z="{z}"/><tangent x="1" y="0" z="0"/>'
        '<rotation x="0" y="1" z="0"/></path_point>'
        for i, (x, y, z) in enumerate(points.tolist())
    )
    return (
        '<?xml version="1.0" encoding="UTF-8" ?><format version="1.0" /><path id="1" method="0">'
        f'<timestep id="0"><path_element><path_points>{rows}</path_points></path_element>'
        "</timestep></path>"
    ).encode()


def tre(*, binary: bool = False) -> bytes:
    """TubeTK's tubes, with a spacing."""
    out = b"ObjectType = Scene\nNDims = 3\nNObjects = 2\n"
    for i, (points, radius) in enumerate(pieces()):
        rows = np.column_stack([2.0 * points, 2.0 * radius, np.arange(len(points))])
        out += (
            f"ObjectType = Tube\nNDims = 3\nBinaryData = {binary}\nID = {i}\nName = tube{i}\n"
            "ElementSpacing = 0.5 0.5 0.5\nPointDim = x y z r id\n"
            f"NPoints = {len(points)}\nPoints = \n"
        ).encode()
        text = "\n".join(" ".join(map(repr, row)) for row in rows.tolist()).encode()
        out += rows.astype("<f4").tobytes() + b"\n" if binary else text + b"\n"
    return out


def markups(system: str = "LPS") -> bytes:
    """3D Slicer's curve with a radius at each control point."""
    points, radius = fork()[0]
    sign = np.array([-1.0, -1.0, 1.0]) if system == "RAS" else np.ones(3)
    curve = {
        "type": "Curve",
        "name": "aorta",
        "coordinateSystem": system,
        "coordinateUnits": "mm",
        "controlPoints": [
            {"id": str(i), "position": p, "positionStatus": "defined"}
            for i, p in enumerate((points * sign).tolist())
        ],
        "measurements": [{"name": "Radius", "controlPointValues": radius.tolist()}],
    }
    return json.dumps({"markups": [curve]}).encode()


def tube(*, closed: bool = False, sides: int = 24) -> tuple[Array, NDArray[np.int64]]:
    """Points and triangles of the bent, tapered tube of the fork's first line."""
    points, radius = (values[::2] for values in fork()[0])
    along = np.gradient(points, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    beside = np.cross(along, [0.0, 0.0, 1.0])
    beside /= np.linalg.norm(beside, axis=1)[:, None]
    above = np.cross(beside, along)
    angle = 2.0 * np.pi * np.arange(sides) / sides
    circle = (
        np.cos(angle)[None, :, None] * beside[:, None]
        + np.sin(angle)[None, :, None] * above[:, None]
    )
    corners = (points[:, None] + radius[:, None, None] * circle).reshape(-1, 3)
    triangles = []
    for i in range(len(points) - 1):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            triangles += [[a, b, a + sides], [b, b + sides, a + sides]]
    if closed:
        for ring, centre in ((0, points[0]), (len(points) - 1, points[-1])):
            corners = np.concatenate([corners, centre[None]])
            for j in range(sides):
                a, b = ring * sides + j, ring * sides + (j + 1) % sides
                triangles.append([a, b, len(corners) - 1])
    return corners, np.array(triangles)


def stl(*, closed: bool = False) -> bytes:
    """A binary STL."""
    corners, triangles = tube(closed=closed)
    out = b"a tube".ljust(80) + struct.pack("<I", len(triangles))
    for triangle in corners[triangles].astype("<f4"):
        out += struct.pack("<3f", 0, 0, 0) + triangle.tobytes() + b"\0\0"
    return out


def obj() -> bytes:
    """A Wavefront OBJ."""
    corners, triangles = tube()
    rows = [f"v {x} {y} {z}" for x, y, z in corners.tolist()]
    return "\n".join([*rows, *(f"f {a} {b} {c}" for a, b, c in (triangles + 1).tolist())]).encode()


def ply() -> bytes:
    """A PLY, as text."""
    corners, triangles = tube()
    head = (
        f"ply\nformat ascii 1.0\nelement vertex {len(corners)}\nproperty float x\n"
        f"property float y\nproperty float z\nelement face {len(triangles)}\n"
        "property list uchar int vertex_indices\n"
        "end_header\n"
    )
    rows = [f"{x} {y} {z}" for x, y, z in corners.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    return (head + "\n".join(rows) + "\n").encode()


STYLES = ("ascii", "binary", "zlib", "raw", "raw-zlib", "base64", "base64-zlib")
CENTRELINES: dict[str, Callable[[], bytes]] = {
    **{f"{style}.vtp": lambda style=style: vtp(style) for style in STYLES},  # type: ignore[misc]
    **{f"{s}.vtk": lambda s=s: vtk(s) for s in ("ascii", "binary", "five")},  # type: ignore[misc]
    "pieces.vtp": lambda: vtp(lines=pieces()),
    "table.csv": table,
    "table.tsv": lambda: table("\t"),
    "table.dat": lambda: table(" "),
    "tree.swc": swc,
    "text.tre": tre,
    "binary.tre": lambda: tre(binary=True),
}
"""Files of the whole fork."""
SINGLE: dict[str, Callable[[], bytes]] = {
    "path.pth": pth,
    "lps.mrk.json": markups,
    "ras.mrk.json": lambda: markups("RAS"),
}
"""Files of its first line only."""
SURFACES: dict[str, Callable[[], bytes]] = {
    "open.stl": stl,
    "closed.stl": lambda: stl(closed=True),
    "tube.obj": obj,
    "tube.ply": ply,
}
"""Files of the wall around its first line."""
EVERY = {**CENTRELINES, **SINGLE, **SURFACES}
