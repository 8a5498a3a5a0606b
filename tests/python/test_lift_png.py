"""Grey images on surfaces as reliefs: heights to the bit depth, seams, and damaged files."""

import struct
import zlib

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, obj_text, succeeded
from cli_support import koebe as command
from test_lift import edges_of, euler, loops_of, stored_areas, tube

GREY, COLOUR, GREY_ALPHA = 0, 2, 4


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(pixels, kind=GREY, size=None):
    """pixels: (height, width) or (height, width, channels) of uint8 or uint16."""
    pixels = np.asarray(pixels)
    height, width = size or pixels.shape[:2]
    rows = b"".join(b"\0" + row.astype(pixels.dtype.newbyteorder(">")).tobytes() for row in pixels)
    head = struct.pack(">IIBBBBB", width, height, 8 * pixels.itemsize, kind, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def square(n=12):
    x, y = (k.ravel() for k in np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1)))
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    a = (n + 1) * i + j
    faces = np.concatenate([np.stack([a, a + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + n + 1], 1)])
    return np.stack([x, y, 0 * x], 1), faces


@pytest.fixture
def lifted(tmp_path):
    def lift(data, mesh=None, **options):
        (tmp_path / "grey.png").write_bytes(data)
        return koebe.lift(*(mesh or tube()), tmp_path / "grey.png", **{"shape": "ring", "height": 0.1, **options})

    return lift


def heights(result):
    """Above the facets of a tube of 60 sides, as far as the normals at its edges allow."""
    return np.hypot(result.vertices[:, 0], result.vertices[:, 1]) - 1


@pytest.mark.parametrize(
    "pixels, kind, share",
    [
        (np.full((4, 4), 255, np.uint8), GREY, 1.0),
        (np.full((4, 4), 51, np.uint8), GREY, 0.2),
        (np.full((4, 4), 12345, np.uint16), GREY, 12345 / 65535),
        (np.full((1, 1), 255, np.uint8), GREY, 1.0),
        (np.full((4, 4, 3), 102, np.uint8), COLOUR, 0.4),
        (np.full((4, 4, 2), (255, 51), np.uint8), GREY_ALPHA, 0.2),
        (np.full((4, 4), 0, np.uint8), GREY, 0.0),
    ],
)
def test_white_has_the_height_and_grey_its_share(lifted, pixels, kind, share):
    result = lifted(png(pixels, kind), mesh=square(), shape="disk", height=0.5)
    assert result.vertices[:, 2] == pytest.approx(0.5 * share, abs=1e-5)
    assert result.outlines == 0 and result.pattern == "grey.png"


def test_the_surface_is_refined_and_stays(lifted):
    vertices, faces = tube()
    result = lifted(png(np.zeros((8, 8), np.uint8)), size=0.05)
    own = result.original >= 0
    assert own.sum() == len(vertices) and (result.vertices[own] == vertices[result.original[own]]).all()
    corners = result.vertices[result.triangles]
    assert np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() <= 0.05 and result.size == 0.05
    assert len(loops_of(result.triangles)) == 2 and euler(result.triangles) == 0
    assert (stored_areas(result.uv) > 0).all()
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    assert area == pytest.approx(2 * 120 * np.sin(np.pi / 60), rel=1e-9)


def test_the_image_goes_on_over_the_cut(lifted):
    wave = np.round(127.5 + 127.5 * np.cos(2 * np.pi * (np.arange(64) + 0.5) / 64)).astype(np.uint8)
    result = lifted(png(np.tile(wave, (8, 1))), repeats=3)
    angle = np.arctan2(result.vertices[:, 1], result.vertices[:, 0])
    on_edge = np.abs(angle * 30 / np.pi - np.round(angle * 30 / np.pi)) < 1e-6
    h, a = heights(result)[on_edge], angle[on_edge]
    fits = [np.abs(h - 0.05 - 0.05 * np.cos(3 * (a - shift))).max() for shift in np.linspace(0, 2 * np.pi / 3, 241)]
    assert min(fits) < 2e-3 and len(set(np.round(a, 6))) >= 60


def test_rows_run_from_rim_to_rim(lifted):
    result = lifted(png(np.repeat([[255], [0]], 4, axis=1).astype(np.uint8)))
    z = result.vertices[:, 2]
    low, high = heights(result)[z < 0.3], heights(result)[z > 1.7]
    ends = sorted([np.median(low), np.median(high)])
    assert ends == pytest.approx([0.0, 0.1], abs=2e-3)


def test_a_solid_relief_is_closed(lifted):
    random = np.random.default_rng(1)
    result = lifted(png(random.integers(0, 256, (20, 60)).astype(np.uint8)), height=0.02, thickness=0.05, size=0.06)
    faces, directed = edges_of(result.triangles)
    assert result.closed and (faces == 2).all() and (directed == 1).all() and euler(result.triangles) == 0


@pytest.mark.parametrize("file", ["circles", "image"])
def test_faces_that_would_turn_over_are_the_surfaces(lifted, file):
    vertices, faces = tube()
    with pytest.raises(koebe.InputError, match="would turn over") as caught:
        if file == "image":
            lifted(png(np.full((2, 2), 255, np.uint8)), height=-1.5, size=0.05)
        else:
            koebe.lift(vertices, faces, file, shape="ring", height=-1.5, size=0.4)
    named = np.array(caught.value.elements)
    assert named.min() >= 0 and named.max() < len(faces) and (np.diff(named) > 0).all()


@pytest.mark.slow
def test_what_an_image_cannot_be(lifted):
    image = png(np.zeros((4, 4), np.uint8))
    for options, message in (
        ({"height": None, "perforate": True}, "give the height of white"),
        ({"shape": "parts"}, "parts have cuts"),
        ({"shape": "disk", "repeats": 2}, "a disk does not repeat"),
        ({"turn": 5}, "an image has no turn"),
        ({"bridge": 0.1}, "a bridge is for outlines"),
        ({"size": 1e-4}, "over four million faces"),
        ({"height": -0.2, "thickness": 0.1}, "sunk through"),
    ):
        with pytest.raises(koebe.InputError, match=message):
            lifted(image, **options)


SOUND = png(np.arange(48, dtype=np.uint8).reshape(6, 8))
DAMAGED = {
    "empty": b"",
    "text": b"<svg/>",
    "signature alone": SOUND[:8],
    "no end": SOUND[:-12],
    "a changed bit": SOUND[:50] + bytes([SOUND[50] ^ 4]) + SOUND[51:],
    "no pixel": png(np.zeros((0, 0), np.uint8), size=(0, 0)),
    "no width": png(np.zeros((4, 4), np.uint8), size=(4, 0)),
    "too few rows": png(np.zeros((4, 4), np.uint8), size=(40, 4)),
    "huge": png(np.zeros((1, 1), np.uint8), size=(60_000, 60_000)),
    "larger than a number": png(np.zeros((1, 1), np.uint8), size=(2**31 - 1, 2**31 - 1)),
    "no data": SOUND[:33] + SOUND[-12:],
    "unknown kind": png(np.zeros((4, 4), np.uint8), kind=5),
}


@pytest.mark.parametrize("data", DAMAGED.values(), ids=DAMAGED.keys())
def test_a_damaged_image_is_refused(lifted, data):
    with pytest.raises(koebe.InputError):
        lifted(data)


def test_no_changed_byte_goes_unseen(lifted):
    for place in range(0, len(SOUND), 3):
        with pytest.raises(koebe.InputError):
            lifted(SOUND[:place] + bytes([SOUND[place] ^ 0x55]) + SOUND[place + 1 :])


def test_the_command_reads_an_image(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*tube()))
    (tmp_path / "a.png").write_bytes(SOUND)
    options = ["--shape", "ring", "--height", "0.05"]
    run = succeeded("lift", "in.obj", "a.png", "out.obj", *options, cwd=tmp_path)
    assert "relief, " in run.stdout, run.stderr
    (tmp_path / "b.png").write_bytes(SOUND[:-3])
    run = command("lift", "in.obj", "b.png", "no.obj", *options, cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and not (tmp_path / "no.obj").exists()
