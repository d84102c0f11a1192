#!/usr/bin/env bash
# SimpleITK 2.5.7: signed distance maps make a vessel half a voxel narrower on every side than it is.
#
# The radius of a centreline is often read from a distance map of the mask. One expects zero on the faces
# between vessel and background, or, as scipy and ITK's unsigned maps do, the distance to the
# nearest background voxel. SignedMaurerDistanceMap and SignedDanielssonDistanceMap are zero at the
# centres of the outermost voxels of the vessel instead: a slab 5 voxels thick has 2 in its middle, scipy
# 3, and half the thickness is 2.5. In tubes ITK's radius is a voxel too small, scipy's right to 0.2: a
# vessel of 3 voxels' diameter has a third of its radius left, one of 6 two thirds. The surface at level
# zero is too narrow by half a voxel, too, and is read as if it were exact. Remedy: take scipy's, or the
# distance from the surface of the mask at 0.5.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "SimpleITK==2.5.7" "scipy==1.17.1" numpy
cd "$work"
"$work/venv/bin/python" - <<'PY'
import numpy as np
import SimpleITK as sitk
from scipy.ndimage import distance_transform_edt

SETTINGS = {"insideIsPositive": True, "squaredDistance": False, "useImageSpacing": True}


def maps(mask):
    """Distances inside of a mask, by four functions."""
    image = sitk.GetImageFromArray(mask.astype(np.uint8))
    return {
        "signed Maurer": sitk.GetArrayFromImage(sitk.SignedMaurerDistanceMap(image, **SETTINGS)),
        "signed Danielsson": sitk.GetArrayFromImage(sitk.SignedDanielssonDistanceMap(image, **SETTINGS)),
        "unsigned Danielsson": sitk.GetArrayFromImage(sitk.DanielssonDistanceMap(1 - image, False, False, True)),
        "scipy": distance_transform_edt(mask),
    }


print("SimpleITK", sitk.Version.VersionString())
slab = np.zeros((15, 15, 21), dtype=bool)
slab[:, :, 8:13] = True
for name, values in maps(slab).items():
    print(f"slab of 5 voxels, {name:20}", values[7, 7, 6:15])
    middle = 2.0 if name.startswith("signed") else 3.0
    assert values[7, 7, 10] == middle, values[7, 7, 10]
    assert values[7, 7, 8] == middle - 2.0
x = np.arange(41) - 20.0
places = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1)
random = np.random.default_rng(0)
for radius in (1.5, 3.0, 6.0):
    off = {}
    for _ in range(40):  # round about this radius, with a voxel's centre close to the axis
        true = radius + random.uniform(-0.25, 0.25)
        mask = np.linalg.norm(places - random.uniform(-0.1, 0.1, 2), axis=-1) <= true
        for name, values in maps(np.repeat(mask[None], 7, axis=0)).items():
            off.setdefault(name, []).append(float(values[3].max()) - true)
    mean = {name: float(np.mean(values)) for name, values in off.items()}
    print(f"tube of radius {radius} voxels, off by", ", ".join(f"{n} {v:+.2f}" for n, v in mean.items()))
    for name in ("signed Maurer", "signed Danielsson"):
        assert -1.5 < mean[name] < -0.8, mean
    for name in ("unsigned Danielsson", "scipy"):
        assert abs(mean[name]) < 0.3, mean
print("As described: zero lies in the outermost voxels of the vessel.")
PY
