"""Samples and times of pictures that are not drawn yet."""

from garage2usd.render.devices import default_samples, drawing_s

WIDE = (1280, 720)


def test_without_samples_two_cores_draw_in_two_minutes():
    for sizes in ([WIDE], [WIDE, WIDE], [(640, 360)] * 3):
        assert 80 <= drawing_s(sizes, sizes, samples=default_samples(sizes), cores=2) <= 120
    assert drawing_s([WIDE], [WIDE], samples=64, cores=2) > 600


def test_many_pictures_get_a_few_samples_and_small_ones_not_too_many():
    assert (default_samples([WIDE] * 300), default_samples([(64, 36)]), default_samples([])) == (2, 64, 64)
