"""The wheel that `make build` makes, beside other packages with a BLAS inside: NumPy's, SciPy's, scikit-learn's."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
KOEBE = """
import koebe
square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.4, 0.5, 0.2]], dtype=float)
map = koebe.uniformize(square, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
face = koebe.uniformize(koebe.example("face"))
assert len(face.loops) == 4 and face.flipped == 0
assert map.flipped == 0 and Path(koebe.__file__).is_relative_to(folder)
"""
OTHERS = """
import scipy.linalg
from sklearn.cluster import KMeans
points = np.random.default_rng(1).normal(size=(2000, 3)) + np.repeat([[0], [9]], 1000, axis=0)
labels = KMeans(2, random_state=1).fit(points).labels_
assert len(set(labels[:1000])) == len(set(labels[1000:])) == 1 and labels[0] != labels[-1]
a = points.T @ points
assert np.allclose(scipy.linalg.cho_solve(scipy.linalg.cho_factor(a), a), np.eye(3))
"""
LAST = """
from threadpoolctl import threadpool_info
assert threadpool_info() and not [pool for pool in threadpool_info() if Path(pool["filepath"]).is_relative_to(folder)
                                  and pool["user_api"] != "openmp"]
"""


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A folder with the wheel for this Python in it, and nothing else."""
    folder = tmp_path_factory.mktemp("wheel")
    tag = "cp{}{}".format(*sys.version_info)
    version = subprocess.check_output([ROOT / "scripts/version.sh"], text=True).strip()
    (wheel,) = (ROOT / "dist").glob(f"koebe-{version}-{tag}-{tag}-*.whl")
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", folder,
                    wheel], check=True)  # fmt: skip
    return folder


def test_the_examples_take_little_room_in_the_wheel(installed):
    version = subprocess.check_output([ROOT / "scripts/version.sh"], text=True).strip()
    tag = "cp{}{}".format(*sys.version_info)
    (wheel,) = (ROOT / "dist").glob(f"koebe-{version}-{tag}-{tag}-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        sizes = [entry.compress_size for entry in archive.infolist() if "/examples/" in entry.filename]
    assert len(sizes) == len(list((installed / "koebe/examples").iterdir())) == 2 and sum(sizes) < 200_000


@pytest.mark.parametrize("order", [(KOEBE, OTHERS), (OTHERS, KOEBE), (OTHERS, KOEBE, OTHERS)],
                         ids=["koebe first", "koebe last", "koebe between"])  # fmt: skip
def test_others_go_on_beside_the_wheel(installed, order):
    start = f"import sys; from pathlib import Path; folder = {str(installed)!r}; sys.path.insert(0, folder)\n"
    code = start + "import numpy as np\n" + "".join(order) + LAST
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
