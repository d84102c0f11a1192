#!/usr/bin/env bash
# ITK 5.4.7: a tube that is a part of another object lies elsewhere once it is added, and again once it is read.
#
# A vessel tree is kept as tubes with parents (.tre), each with a frame in that of its parent. When a tube that has a
# frame is added to a group, it may stay where it is, or it may go along with the group; ITK means it to
# stay. It does if the group is only moved. If one of the two is turned, it is neither: a tube at (0, 10, 0), turned by 90 degrees, that is
# added to a group at (100, 0, 0) lies at (200, -190, 0). And of a tree that is right, and written rightly, the reader leaves out the frames of
# all parts: a branch whose frame is 10 mm from the trunk's and of twice the scale is read at the trunk, at half its
# length. Positions that are asked of ITK after reading are wrong without a word; the text of the file is right. Remedy: set
# the frame after adding; write tubes without parents, in the frame of the image.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "itk-core==5.4.7" "itk-numerics==5.4.7" "itk-io==5.4.7" numpy
cd "$work"
"$work/venv/bin/python" - <<'PY'
import itk
import numpy as np

TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
made = []  # kept for as long as ITK points at them


def framed(thing, matrix, offset):
    frame = itk.AffineTransform[itk.D, 3].New()
    frame.SetMatrix(itk.matrix_from_array(np.asarray(matrix)))
    frame.SetOffset(list(map(float, offset)))
    thing.SetObjectToParentTransform(frame)
    thing.Update()
    made.append((thing, frame))
    return thing


def tube():
    """A tube along x of its own frame, 9 mm long."""
    found = itk.TubeSpatialObject[3].New()
    for along in range(10):
        point = itk.TubeSpatialObjectPoint[3]()
        point.SetPositionInObjectSpace([float(along), 0.0, 0.0])
        point.SetRadiusInObjectSpace(1.0)
        found.AddPoint(point)
    return found


def ends(found):
    return [np.round(list(found.GetPoint(i).GetPositionInWorldSpace()), 6) + 0.0 for i in (0, 9)]


def group():
    return itk.GroupSpatialObject[3].New()


print("ITK", itk.Version.GetITKVersion())
stays = {}
for name, outer, inner in (
    ("neither turned", np.eye(3), np.eye(3)),
    ("the tube turned", np.eye(3), TURN),
    ("the group turned", TURN, np.eye(3)),
):
    whole, part = framed(group(), outer, (100, 0, 0)), framed(tube(), inner, (0, 10, 0))
    alone = ends(part)[0]
    whole.AddChild(part)
    whole.Update()
    added = ends(part)[0]
    along = outer @ alone + [100, 0, 0]
    print(f"{name:16}: alone at {alone}, added to a group at {added}; with the group it would be at {along}")
    stays[name] = np.allclose(added, alone)
    assert stays[name] or not np.allclose(added, along)
assert list(stays.values()) == [True, False, False]

whole, part = framed(group(), TURN, (100, 0, 0)), tube()
whole.SetId(1)
part.SetId(2)
whole.AddChild(part)
framed(part, 2.0 * np.eye(3), (0, 10, 0))
whole.Update()
right = ends(part)
assert np.allclose(right, [(90, 0, 0), (90, 18, 0)])
writer = itk.SpatialObjectWriter[3].New()
writer.SetInput(whole)
writer.SetFileName("tree.tre")
writer.Update()
text = open("tree.tre").read()
assert "ParentID = 1" in text and "TransformMatrix = 2 0 0 0 2 0 0 0 2" in text and "Offset = 0 10 0" in text
reader = itk.SpatialObjectReader[3].New()
reader.SetFileName("tree.tre")
reader.Update()
scene = reader.GetGroup()
scene.Update()
again = ends(itk.down_cast(scene.GetObjectById(2)))
print("written from", *right, "- read to", *again)
assert np.allclose(again, [(100, 0, 0), (100, 9, 0)])
print("As described: the frames of parts are lost.")
PY
