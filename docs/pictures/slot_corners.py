"""Draw the corners of slots over rendered pictures: yellow ones are seen, magenta ones hidden; green lines are entries.

Usage: python docs/pictures/slot_corners.py FOLDER PICTURE [--frame NAME_CONTAINS] [--kind colour]
"""

import argparse
import json
from itertools import pairwise
from pathlib import Path

from PIL import Image, ImageDraw

_SEEN, _HIDDEN, _ENTRY = (255, 214, 10), (255, 0, 200), (64, 220, 90)
_DOT_PX = 4
_VISIBLE = 2


def main() -> None:
    """Draw the corners of the frame over its picture."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--frame", default="")
    options = parser.parse_args()
    told = json.loads((options.folder / "slots_coco.json").read_text(encoding="utf-8"))
    image = next(each for each in told["images"] if options.frame in each["file_name"])
    picture = Image.open(options.folder / image["file_name"]).convert("RGB")
    pen = ImageDraw.Draw(picture)
    for slot in told["annotations"]:
        if slot["image_id"] != image["id"] or "keypoints" not in slot:
            continue
        numbers = slot["keypoints"]
        corners = [(numbers[k], numbers[k + 1], numbers[k + 2]) for k in range(0, len(numbers), 3)]
        for (x0, y0, seen0), (x1, y1, seen1) in pairwise(corners[:2]):
            if seen0 and seen1:
                pen.line([(x0, y0), (x1, y1)], _ENTRY, 2)
        for x, y, seen in corners:
            if seen:
                colour = _SEEN if seen == _VISIBLE else _HIDDEN
                pen.ellipse([x - _DOT_PX, y - _DOT_PX, x + _DOT_PX, y + _DOT_PX], fill=colour, outline=(20, 20, 20))
    picture.save(options.picture)


if __name__ == "__main__":
    main()
