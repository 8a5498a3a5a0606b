"""The factors that bench/predicted_rates.py takes from the circles alone are those of the iteration."""

from pathlib import Path

import koebe
import numpy as np
import predicted_rates
import proof_pictures
import pytest
import table_surfaces

ROOT = Path(__file__).resolve().parents[2]
CIRCLES = [(0j, 1.0), (-0.4 + 0.2j, 0.3), (0.45 - 0.1j, 0.25), (0.1 + 0.6j, 0.2)]


@pytest.fixture(autouse=True)
def fewer_modes(monkeypatch):
    monkeypatch.setattr(predicted_rates, "MODES", 24)


@pytest.mark.parametrize("radius", [0.3, 0.5])
def test_ck_on_a_ring_gains_the_fourth_power_of_its_radius(radius):
    found = predicted_rates.predicted([(0j, 1.0), (0j, radius)])
    assert abs(found["CK"][0]) == pytest.approx(radius**4, rel=1e-3)
    assert abs(found["first"][0]) == abs(found["GK"][0]) == abs(found["at once"][0]) == 0.0


def moved(circle, a):
    """By the automorphism of the disk that takes a to 0."""
    center, radius = circle
    w = [(z - a) / (1 - np.conj(a) * z) for z in center + radius * np.exp(2j * np.pi * np.arange(3) / 3)]
    rows = [[2 * (z - w[0]).real, 2 * (z - w[0]).imag] for z in w[1:]]
    middle = complex(*np.linalg.solve(rows, [abs(z) ** 2 - abs(w[0]) ** 2 for z in w[1:]]))
    return middle, abs(w[0] - middle)


def test_an_automorphism_of_the_disk_changes_no_factor():
    there = predicted_rates.predicted([moved(circle, 0.3 + 0.1j) for circle in CIRCLES])
    for run, values in predicted_rates.predicted(CIRCLES).items():
        assert abs(there[run][0]) == pytest.approx(abs(values[0]), rel=1e-3)


@pytest.mark.slow
def test_no_sweep_is_slower_than_the_proof_says():
    bounds = []
    for row in predicted_rates.DOMAINS.values():
        circles = predicted_rates.draw(*row)
        bounds.append(predicted_rates.proved(circles))
        for values in predicted_rates.predicted(circles).values():
            assert abs(values[0]) < bounds[-1] < 1.0
    page = (ROOT / "docs" / "proof.md").read_text(encoding="utf-8")
    assert f"$t^{{-4}}$ is {min(bounds):.2f} to {max(bounds):.2f}" in page


def test_each_letter_divides_the_area_as_the_proof_says():
    """Both collars of each word, as circles: nested as Lemma 2 needs it, and the sum of areas below P3."""
    drawn = predicted_rates.draw(3, 2)
    circles, ratio = predicted_rates.turned_out(drawn), predicted_rates.proved(drawn) ** 0.25  # 1 / t

    def edge(word, size, mirrors):
        """The circle of the last letter, larger by a factor, after the mirrors of the letters before."""
        circle = (circles[word[-1]][0], circles[word[-1]][1] * size)
        for k in reversed(mirrors):
            circle = proof_pictures.reflected(circle, circles[k])
        return circle

    def fits(inner, outer):
        return abs(inner[0] - outer[0]) + inner[1] <= outer[1] + 1e-14

    words, first = [(k,) for k in range(len(circles))], sum(r * r for _, r in circles)
    for letters in range(1, 5):
        for word in words:
            inside = edge(word, ratio, word[:-1])  # the inner edge of its inner collar
            assert (inside[1] / edge(word, 1 / ratio, word[:-1])[1]) ** 2 <= ratio**4 * (1 + 1e-9)
            children = [(*word, k) for k in range(len(circles)) if k != word[-1]]
            assert all(fits(edge(child, 1 / ratio, word), inside) for child in children)
        words = [(*word, k) for word in words for k in range(len(circles)) if k != word[-1]]
        assert sum(edge(word, 1.0, word[:-1])[1] ** 2 for word in words) <= first * ratio ** (4 * letters)


ORDERS = {
    "CK": lambda n: [(k,) for k in range(n)],
    "first": lambda n: [(0, k) for k in range(1, n)],
    "GK": lambda n: [(k, k + 1) for k in range(0, n - 1, 2)] + [(0, n - 1)] * (n % 2),
}


@pytest.mark.parametrize("n", [3, 4, 5])
def test_a_sweep_of_each_order_raises_the_level_of_the_proof(n):
    """All words of so many letters, by Lemma 1's own words and not by its counts."""
    for order in ORDERS.values():
        words = proof_pictures.start(n)
        for sweep in range(1, 4):
            for step in order(n):
                words = proof_pictures.after_step(words, step)
            assert proof_pictures.level(words) >= sweep
    words = proof_pictures.start(n)
    for sweep in range(1, 4):
        words = proof_pictures.after_sweep_at_once(words)
        assert proof_pictures.level(words) == sweep
    words = proof_pictures.start(n)
    for steps in range(1, 2 * n):  # pairs that run on round the loops
        words = proof_pictures.after_step(words, ((2 * steps - 2) % n, (2 * steps - 1) % n))
        assert proof_pictures.level(words) >= 2 * steps // n


@pytest.mark.parametrize("name", ["levels", "collars"])
def test_the_pictures_of_the_proof_are_what_the_script_draws(name):
    drawn = (ROOT / "docs" / "images" / f"proof_{name}.svg").read_text(encoding="utf-8")
    assert drawn == getattr(proof_pictures, f"{name}_picture")()


@pytest.mark.skipif(not table_surfaces.MESHER.exists(), reason="build/bench/planar_mesher is not built")
@pytest.mark.parametrize("run", ["CK", "at once"])
def test_the_iteration_has_the_factor_of_its_circles(run, monkeypatch):
    monkeypatch.setattr(predicted_rates, "RUNS", {run: predicted_rates.RUNS[run]})
    expected, found, _ = predicted_rates.factors(koebe, "2 holes, draw 1")
    assert found[run] == pytest.approx(abs(expected[run][0]), rel=0.05)
