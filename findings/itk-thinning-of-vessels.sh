#!/usr/bin/env bash
# SimpleITK 2.5.7: BinaryThinning takes a vessel to its centreline only if it runs across the slices.
#
# It takes images of three dimensions and promises lines one pixel wide, and for the centreline of a vessel
# one tries it first; that its method is one of two dimensions stands in its reference, not in what it does. It thins each slice
# by itself. A vessel along z, at which one would test it, comes out as one line of voxels, as it should. The
# same vessel along x or y comes as a plate of one voxel's thickness, as wide as the vessel. No error, no warning.
# Remedy: skeletonize of scikit-image, which gives one line in each direction.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "SimpleITK==2.5.7" "scikit-image==0.26.0" numpy
cd "$work"
"$work/venv/bin/python" - <<'PY'
import numpy as np
import SimpleITK as sitk
import skimage
from skimage.morphology import skeletonize

along, across = np.meshgrid(np.arange(60) - 30, np.arange(31) - 15, indexing="ij")
round_about = across[:, :, None] ** 2 + across[:, None, :] ** 2
vessel = ((round_about <= 16) & (np.abs(along)[:, :, None] < 25)).astype(np.uint8)  # axis first: along z

print("SimpleITK", sitk.Version.VersionString(), "- scikit-image", skimage.__version__)
for name, mask in (("z", vessel), ("y", np.moveaxis(vessel, 0, 1)), ("x", np.moveaxis(vessel, 0, 2))):
    axis = "zyx".index(name)
    mask = np.ascontiguousarray(mask)
    thinned = sitk.GetArrayFromImage(sitk.BinaryThinning(sitk.GetImageFromArray(mask))) > 0
    skeleton = skeletonize(mask.astype(bool))
    counts = []
    for found in (thinned, skeleton):
        crossed = np.moveaxis(found, axis, 0)[15:45].reshape(30, -1).sum(axis=1)  # voxels in a section
        counts.append(crossed)
    wide = np.ptp(np.argwhere(np.moveaxis(thinned, axis, 0)[15:45])[:, 1:], axis=0).max() + 1
    print(
        f"vessel along {name}, 9 voxels wide: thinned to {counts[0].mean():.1f} voxels in a section, "
        f"{wide} wide; skeletonize {counts[1].mean():.1f}"
    )
    assert np.all(counts[1] == 1)
    assert np.all(counts[0] == 1) if name == "z" else counts[0].mean() > 6.0 and wide == 9
print("As described: slice by slice.")
PY
