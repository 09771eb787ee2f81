"""Loads every annotation file of a dataset with pycocotools and compares it with the images and masks.

    pip install pycocotools pillow numpy
    python tests/consumers/check_coco.py out/NAME

Exits with 1 and a list of differences if there are any.
"""

import argparse
import contextlib
import io
import sys
from pathlib import Path

import numpy as np
from PIL import Image
from pycocotools.coco import COCO


def ids_differ(kind, ids):
    """Ids must count from 1 without gaps."""
    if ids != list(range(1, len(ids) + 1)):
        yield f"{kind} ids are not 1 to {len(ids)}"


def annotation_differs(coco, annotation, shape):
    """A decoded run-length mask must have the area and the extent that its annotation names."""
    if tuple(annotation["segmentation"]["size"]) != shape:
        yield f"segmentation is for {annotation['segmentation']['size']}, the image is {shape}"
        return
    mask = coco.annToMask(annotation)
    rows, columns = np.nonzero(mask)
    if len(rows) == 0:
        yield "mask is empty"
        return
    if len(rows) != annotation["area"]:
        yield f"area is {annotation['area']}, the mask has {len(rows)} pixels"
    left, top = int(columns.min()), int(rows.min())
    extent = [left, top, int(columns.max()) - left + 1, int(rows.max()) - top + 1]
    if extent != annotation["bbox"]:
        yield f"box is {annotation['bbox']}, the mask extends over {extent}"


def mask_differs(coco, annotations, dominant):
    """The mask image names annotated instances only, each within its own run-length mask."""
    instances = [annotation["instance"] for annotation in annotations]
    if len(set(instances)) != len(instances):
        yield f"instances {instances} are not distinct"
    strangers = sorted(set(np.unique(dominant).tolist()) - {0} - set(instances))
    if strangers:
        yield f"mask image has the instances {strangers}, which have no annotation"
    for annotation in annotations:
        outside = (dominant == annotation["instance"]) & (coco.annToMask(annotation) == 0)
        if outside.any():
            yield f"{int(outside.sum())} pixels of instance {annotation['instance']} are outside its annotation"


def image_differs(root, coco, image):
    shape = (image["height"], image["width"])
    picture = root / image["file_name"]
    if not picture.is_file():
        yield "the file is missing"
        return
    with Image.open(picture) as opened:
        if opened.size != shape[::-1] or opened.mode != "L":
            yield f"the file is {opened.mode} {opened.size}, not L {shape[::-1]}"
    annotations = coco.loadAnns(coco.getAnnIds(image["id"]))
    for annotation in annotations:
        for difference in annotation_differs(coco, annotation, shape):
            yield f"annotation {annotation['id']}: {difference}"
    mask = root / image["file_name"].replace("images/", "masks/", 1)
    if mask.is_file():
        with Image.open(mask) as opened:
            dominant = np.array(opened)
        if dominant.shape != shape:
            yield f"the mask image is {dominant.shape}, not {shape}"
        else:
            yield from mask_differs(coco, annotations, dominant)


def file_differs(root, path):
    with contextlib.redirect_stdout(io.StringIO()):
        coco = COCO(str(path))
    data = coco.dataset
    yield from ids_differ("annotation", [annotation["id"] for annotation in data["annotations"]])
    yield from ids_differ("category", [category["id"] for category in data["categories"]])
    images = [image["id"] for image in data["images"]]
    if images != sorted(set(images)):
        yield "images are not in order"
    for kind, key, known in [("image", "image_id", coco.imgs), ("category", "category_id", coco.cats)]:
        for annotation in data["annotations"]:
            if annotation[key] not in known:
                yield f"annotation {annotation['id']} is of {kind} {annotation[key]}, which is not there"
    for image in data["images"]:
        for difference in image_differs(root, coco, image):
            yield f"{image['file_name']}: {difference}"
    print(f"{path.name}: {len(images)} images, {len(data['annotations'])} annotations")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path)
    root = parser.parse_args().dataset
    files = sorted((root / "annotations").glob("*.json"))
    if not files:
        sys.exit(f"{root} has no annotations/*.json: is it a finished dataset?")
    differences = [f"{path.name}: {difference}" for path in files for difference in file_differs(root, path)]
    for difference in differences:
        print(difference, file=sys.stderr)
    if differences:
        sys.exit(f"{root}: {len(differences)} differences")
    print(f"{root}: {len(files)} annotation files agree with their images and masks")


if __name__ == "__main__":
    main()
