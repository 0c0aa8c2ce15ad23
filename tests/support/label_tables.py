"""The objects in a table of labels, read as any program may that knows the documentation alone."""

import json


def labelled_objects(path):
    """Each object's columns, the path of its prim and the name of its class, in the order of the ids."""
    table = json.loads(path.read_text())
    classes = {entry["id"]: entry["name"] for entry in table["classes"]}
    entries = [
        dict(zip(table["columns"], row, strict=True)) | {"path": f"{parent}/{row[0]}"}
        for parent, rows in table["objects"].items()
        for row in rows
    ]
    return sorted(({**entry, "class": classes[entry["class_id"]]} for entry in entries), key=lambda entry: entry["id"])


def cars_of_plates(path):
    """The id of its car for the id of each pair of number plates, whose pixels and points have the car's."""
    return {plates: car for plates, car, _ in json.loads(path.read_text())["number_plates"]}
