"""A result as a log of ROS 2 messages, which Foxglove, PlotJuggler and rosbag2 read."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.errors import MagwireError
from magwire.export.frames import Frame, turned
from magwire.files import successor

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
FILE = "result.mcap"
RULE = "=" * 80

# The fields of ROS 2's interfaces: https://docs.ros.org/en/rolling/p/geometry_msgs, /sensor_msgs.
PARTS = {
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec\n",
    "geometry_msgs/Pose": "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
    "geometry_msgs/Wrench": "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n",
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
}
STAMP = ("std_msgs/Header", "builtin_interfaces/Time")
MESSAGES = {
    "geometry_msgs/msg/PoseArray": (
        "std_msgs/Header header\ngeometry_msgs/Pose[] poses\n",
        (*STAMP, "geometry_msgs/Pose", "geometry_msgs/Point", "geometry_msgs/Quaternion"),
    ),
    "geometry_msgs/msg/WrenchStamped": (
        "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n",
        (*STAMP, "geometry_msgs/Wrench", "geometry_msgs/Vector3"),
    ),
    "sensor_msgs/msg/MagneticField": (
        "std_msgs/Header header\ngeometry_msgs/Vector3 magnetic_field\n"
        "float64[9] magnetic_field_covariance\n",
        (*STAMP, "geometry_msgs/Vector3"),
    ),
}
TOPICS = {
    "/magwire/wire": "geometry_msgs/msg/PoseArray",
    "/magwire/tip/wall_wrench": "geometry_msgs/msg/WrenchStamped",
    "/magwire/guide/wrench": "geometry_msgs/msg/WrenchStamped",
    "/magwire/field": "sensor_msgs/msg/MagneticField",
}
"""The wire's nodes with x along the wire; the wall's force on the tip; push and torque of the guide
along the guide; the flux density at the tip [T]."""


class LogError(MagwireError):
    """A log that cannot be written."""


def write_mcap(data: xr.Dataset, folder: Path, frame: Frame = "lps") -> list[Path]:
    """Write ``result.mcap``: a message of each topic a record, stamped with simulated time.

    Parameters
    ----------
    data
        A result file's variables and attributes.
    folder
        Where to.
    frame
        Axes of all vectors; also the messages' ``frame_id``, as "magwire_lps".

    Raises
    ------
    LogError
        If the packages that write such logs are missing.
    """
    try:
        from mcap_ros2.writer import Writer
    except ModuleNotFoundError:
        raise LogError(
            "A log needs the packages mcap and mcap-ros2-support, which are not installed; "
            "install them with 'pip install magwire[export]'."
        ) from None
    path = folder / FILE
    with successor(path) as draft, draft.open("wb") as file, Writer(file) as writer:
        schemas = {name: writer.register_msgdef(name, definition(name)) for name in MESSAGES}
        for record, stamp in enumerate(stamps(data)):
            for topic, message in messages(data, record, frame, stamp):
                writer.write_message(
                    topic, schemas[TOPICS[topic]], message, log_time=stamp, sequence=record
                )
    return [path]


def definition(name: str) -> str:
    """The definition of a message with those of its parts, as logs hold it."""
    own, parts = MESSAGES[name]
    return own + "".join(f"{RULE}\nMSG: {part}\n{PARTS[part]}" for part in parts)


def stamps(data: xr.Dataset) -> list[int]:
    """Simulated time of the records [ns]."""
    return [round(1e9 * time) for time in data["time"].values.tolist()]


def messages(
    data: xr.Dataset, record: int, frame: Frame, stamp: int
) -> Iterator[tuple[str, dict[str, Any]]]:
    """The messages of a record by topic."""
    header = {
        "stamp": {"sec": stamp // 10**9, "nanosec": stamp % 10**9},
        "frame_id": f"magwire_{frame}",
    }
    nodes = turned(data["position"].values[record], frame)
    poses = [
        {"position": _named(node), "orientation": _named(turn, "xyzw")}
        for node, turn in zip(nodes, orientations(nodes), strict=True)
    ]
    yield "/magwire/wire", {"header": header, "poses": poses}
    tip = turned(data["contact_force"].values[record, -1], frame)
    yield "/magwire/tip/wall_wrench", {"header": header, "wrench": _wrench(tip, np.zeros(3))}
    along = _guide(data, frame)
    push, torque = (float(data[name].values[record]) for name in ("push_force", "guide_torque"))
    yield (
        "/magwire/guide/wrench",
        {"header": header, "wrench": _wrench(push * along, torque * along)},
    )
    field = turned(data["field"].values[record], frame)
    unknown = [0.0] * 9  # ROS: zeros are a covariance that nobody knows
    covariance = {"magnetic_field_covariance": unknown}
    yield "/magwire/field", {"header": header, "magnetic_field": _named(field), **covariance}


def orientations(nodes: Array) -> Array:
    """Quaternions x y z w that turn x into the direction of the wire, shape (n, 4)."""
    edges = np.diff(nodes, axis=0)
    along = np.concatenate([edges, edges[-1:]])
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    found = np.zeros((len(nodes), 4))
    found[:, 1], found[:, 2], found[:, 3] = -along[:, 2], along[:, 1], 1.0 + along[:, 0]
    back = found[:, 3] < 1e-9  # half a turn: about z, as good as any
    found[back] = [0.0, 0.0, 1.0, 0.0]
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


def _guide(data: xr.Dataset, frame: Frame) -> Array:
    """Direction of the guide: that of the wire's first edge before anything is fed."""
    first = turned(data["position"].values[0], frame)
    edge = first[1] - first[0]
    return np.asarray(edge / np.linalg.norm(edge))


def _named(values: Array, names: str = "xyz") -> dict[str, float]:
    return dict(zip(names, values.tolist(), strict=True))


def _wrench(force: Array, torque: Array) -> dict[str, dict[str, float]]:
    return {"force": _named(force), "torque": _named(torque)}
