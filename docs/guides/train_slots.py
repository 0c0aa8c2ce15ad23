"""Train a small network on the corners of slots, as `garage2usd render --slots coco` tells them.

Usage: python train_slots.py FOLDER EPOCHS

Needs torch and pycocotools.
"""

import json
import sys
from pathlib import Path

import numpy as np
import torch
from PIL import Image
from pycocotools.coco import COCO

HEIGHT, WIDTH, STRIDE = 192, 320, 4
SEEN = 2
"""COCO's visibility of a corner that is seen."""


class Slots(torch.utils.data.Dataset):
    """Pictures, and for each of the four corners a map with a peak where one is seen."""

    def __init__(self, folder: str) -> None:
        """Read the truth of a folder."""
        self.folder, self.truth = Path(folder), COCO(str(Path(folder) / "slots_coco.json"))
        self.ids = self.truth.getImgIds()

    def __len__(self) -> int:
        """The number of pictures."""
        return len(self.ids)

    def __getitem__(self, number: int) -> tuple[torch.Tensor, torch.Tensor]:
        """A picture, shape (3, HEIGHT, WIDTH), and its maps."""
        about = self.truth.loadImgs(self.ids[number])[0]
        picture = Image.open(self.folder / about["file_name"]).convert("RGB").resize((WIDTH, HEIGHT))
        scale = np.array([WIDTH / about["width"], HEIGHT / about["height"]]) / STRIDE
        rows, columns = np.mgrid[: HEIGHT // STRIDE, : WIDTH // STRIDE] + 0.5
        maps = np.zeros((4, HEIGHT // STRIDE, WIDTH // STRIDE), dtype=np.float32)
        for slot in self.truth.loadAnns(self.truth.getAnnIds(self.ids[number], catIds=[1])):
            for corner, (*place, visibility) in enumerate(np.reshape(slot["keypoints"], (4, 3))):
                if visibility == SEEN:
                    x, y = place * scale
                    peak = np.exp(-((columns - x) ** 2 + (rows - y) ** 2) / 2)
                    maps[corner] = np.maximum(maps[corner], peak)
        pixels = torch.from_numpy(np.asarray(picture, dtype=np.float32) / 255).permute(2, 0, 1)
        return pixels, torch.from_numpy(maps)


def block(inputs: int, outputs: int, stride: int) -> torch.nn.Module:
    """One layer."""
    convolution = torch.nn.Conv2d(inputs, outputs, 3, stride=stride, padding=1)
    return torch.nn.Sequential(convolution, torch.nn.BatchNorm2d(outputs), torch.nn.ReLU())


def main(folder: str, epochs: int) -> None:
    """Train, and count the corners of the same pictures that are found."""
    torch.manual_seed(0)
    slots = Slots(folder)
    network = torch.nn.Sequential(
        block(3, 16, 2), block(16, 32, 2), block(32, 32, 1), block(32, 32, 1), torch.nn.Conv2d(32, 4, 1)
    )
    optimiser = torch.optim.Adam(network.parameters(), lr=3e-3)
    loader = torch.utils.data.DataLoader(slots, batch_size=4, shuffle=True)
    for epoch in range(epochs):
        losses = []
        for pictures, maps in loader:
            weight = 1 + 50 * maps  # corners are few
            loss = (weight * (network(pictures).sigmoid() - maps) ** 2).mean()
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            losses.append(loss.item())
        if epoch % 20 == 0 or epoch == epochs - 1:
            print(epoch, round(float(np.mean(losses)), 4), flush=True)
    network.eval()
    hits = total = 0
    with torch.no_grad():
        for pictures, maps in torch.utils.data.DataLoader(slots):
            seen = maps > 0.9  # noqa: PLR2004 - the peak's own pixel
            hits += int((network(pictures).sigmoid()[seen] > 0.3).sum())  # noqa: PLR2004
            total += int(seen.sum())
    print(json.dumps({"pictures": len(slots), "corners": total, "found": hits}))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
