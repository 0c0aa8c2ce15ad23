"""Run by the interpreter of the judges: feed truth in COCO's formats back to COCO's own evaluations.

Usage: coco_judge.py keypoints FILE | panoptic FILE FOLDER

Prints a JSON object: average precisions by evaluation, or panoptic quality by group and the number of segments.
"""

import contextlib
import json
import sys

import numpy as np


def keypoints(path):
    import pycocotools.coco
    import pycocotools.cocoeval
    from faster_coco_eval import COCO, COCOeval_faster

    judges = {
        "pycocotools": (pycocotools.coco.COCO, pycocotools.cocoeval.COCOeval),
        "faster_coco_eval": (COCO, COCOeval_faster),
    }
    found = {}
    for name, (reader, evaluation) in judges.items():
        truth = reader(path)
        guesses = [
            {key: entry[key] for key in ("image_id", "category_id", "bbox", "keypoints", "segmentation")}
            | {"score": 1.0, "segmentation": truth.annToRLE(entry)}
            for entry in truth.loadAnns(truth.getAnnIds())
        ]
        for kind in ("bbox", "segm", "keypoints"):
            keys = {"bbox": ("bbox",), "segm": ("segmentation",), "keypoints": ("keypoints",)}[kind]
            told = [{key: guess[key] for key in ("image_id", "category_id", "score", *keys)} for guess in guesses]
            run = evaluation(truth, truth.loadRes(told), kind)
            if kind == "keypoints":
                run.params.kpt_oks_sigmas = np.full(4, 0.025)
                run.params.maxDets = [1000]
            else:
                run.params.maxDets = [1, 10, 1000]
            run.evaluate()
            run.accumulate()
            precision = run.eval["precision"][..., -1]  # with as many guesses as there are
            found[f"{name} {kind}"] = float(precision[precision > -1].mean())
        found[f"{name} annotations"] = len(guesses)
        masks = [abs(int(truth.annToMask(entry).sum()) - entry["area"]) for entry in truth.loadAnns(truth.getAnnIds())]
        around = [2 * sum(entry["bbox"][2:]) + 4 for entry in truth.loadAnns(truth.getAnnIds())]
        found[f"{name} masks"] = max(mask / most for mask, most in zip(masks, around, strict=True))
    return found


def panoptic(path, folder):
    from panopticapi.evaluation import pq_compute

    result = pq_compute(path, path, folder, folder)
    return {group: result[group] for group in ("All", "Things", "Stuff")}


if __name__ == "__main__":
    with contextlib.redirect_stdout(sys.stderr):
        answer = {"keypoints": keypoints, "panoptic": panoptic}[sys.argv[1]](*sys.argv[2:])
    sys.stdout.write(json.dumps(answer))
