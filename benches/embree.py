"""Rays a second of Embree, through its Python binding, on the surface and with the camera of the CPU benchmark.

    pip install embreex numpy
    python3 benches/embree.py [PROCESSES]

The binding traces on one thread, so each process takes its share of the picture's rows. The best of seven rounds counts.
"""

import multiprocessing
import sys
import time

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh

WIDTH, HEIGHT = 1280, 720
TRIANGLES = 1_000_000
ROUNDS = 7


def surface():
    """Twin of `support::surface`."""
    side = int(np.ceil(np.sqrt(0.5 * TRIANGLES)))
    along = 2.0 * np.arange(side + 1, dtype=np.float32) / side - 1.0
    x, z = np.meshgrid(along, along)
    y = 0.12 * np.sin(9 * x) * np.cos(7 * z) + 0.02 * np.sin(40 * x + 31 * z)
    points = np.stack([x, y, z], -1).reshape(-1, 3).astype(np.float32)
    corner = np.arange((side + 1) ** 2, dtype=np.int32).reshape(side + 1, side + 1)
    a, b, c, d = (q.ravel() for q in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]))
    return points, np.concatenate([np.stack([a, d, c], -1), np.stack([a, c, b], -1)])


def rays(rows):
    """Through the pixel centres of some rows, as `View::ray` has them."""
    eye, target = np.array([0.0, 1.5, 2.2]), np.zeros(3)
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    half = np.tan(np.radians(45.0) / 2)
    x = (2 * (np.arange(WIDTH) + 0.5) / WIDTH - 1) * half * WIDTH / HEIGHT
    y = (1 - 2 * (rows + 0.5) / HEIGHT) * half
    across = x[None, :, None] * right + y[:, None, None] * up
    directions = (forward + across).reshape(-1, 3).astype(np.float32)
    return np.tile(eye.astype(np.float32), (len(directions), 1)), directions


def work(share, shares, start, results):
    points, triangles = surface()
    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, points, triangles)
    origins, directions = rays(np.arange(share, HEIGHT, shares))
    hits = scene.run(origins, directions)
    for _ in range(ROUNDS):
        start.wait()
        began = time.perf_counter()
        scene.run(origins, directions)
        results.put((time.perf_counter() - began, int((hits >= 0).sum())))


def main():
    shares = int(sys.argv[1]) if len(sys.argv) > 1 else 2
    start, results = multiprocessing.Barrier(shares), multiprocessing.Queue()
    workers = [multiprocessing.Process(target=work, args=(i, shares, start, results)) for i in range(shares)]
    for worker in workers:
        worker.start()
    rounds = [[results.get() for _ in workers] for _ in range(ROUNDS)]
    for worker in workers:
        worker.join()
    seconds = min(max(taken for taken, _ in shares_of) for shares_of in rounds)
    hit = sum(hits for _, hits in rounds[0])
    print(f"{hit} of {WIDTH * HEIGHT} rays hit; {seconds * 1e3:.1f} ms, {WIDTH * HEIGHT / seconds / 1e6:.1f} million rays a second")


if __name__ == "__main__":
    main()
