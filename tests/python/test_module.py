# SPDX-License-Identifier: BSD-3-Clause
import gc
import threading
import unittest

import disflow
import numpy as np
from box_scene import CAMERA, HALF_BOX_M, HEIGHT, WIDTH, depth_at, pose_at, stamp_at

FRAMES = 20


def tracked(frames=FRAMES, **options):
    tracker = disflow.Tracker(**options)
    estimates = [tracker.process(depth_at(i / 30), CAMERA, stamp_at(i)) for i in range(frames)]
    return tracker, estimates


class Tracking(unittest.TestCase):
    def test_pose_follows_the_truth(self):
        _, estimates = tracked()
        self.assertTrue(all(e.ok for e in estimates))
        # The object frame starts anywhere on the object: what it moves by is compared.
        first, last = estimates[0].T_co, estimates[-1].T_co
        truth = pose_at((FRAMES - 1) / 30) @ np.linalg.inv(pose_at(0.0))
        np.testing.assert_allclose(last @ np.linalg.inv(first), truth, atol=2e-3)
        self.assertEqual(estimates[-1].kind, 'measured')
        self.assertEqual(estimates[-1].state, 'tracking')
        np.testing.assert_allclose(estimates[-1].angular_rps, pose_at(0)[:3, :3] @ [0, 0.8, 0], atol=0.1)

    def test_raw_units_give_the_pose_of_metres(self):
        a, b = disflow.Tracker(), disflow.Tracker()
        for i in range(5):
            millimetres = np.round(depth_at(i / 30) * 1000)
            raw = a.process(millimetres.astype(np.uint16), CAMERA, stamp_at(i))
            metres = b.process((millimetres * 1e-3).astype(np.float32), CAMERA, stamp_at(i))
            np.testing.assert_allclose(raw.position_m, metres.position_m, atol=1e-4)

    def test_mask_and_label_choose_the_object(self):
        depth = depth_at(0.0)
        labels = np.where(depth < 1.0, 7, 3).astype(np.uint8)
        by_label = disflow.Tracker().process(depth, CAMERA, 1, mask=labels, mask_label=7)
        by_truth = disflow.Tracker().process(depth, CAMERA, 1, mask=depth < 1.0)
        np.testing.assert_array_equal(by_label.position_m, by_truth.position_m)
        self.assertTrue(by_truth.ok)
        nothing = disflow.Tracker().process(depth, CAMERA, 1, mask=np.zeros_like(labels))
        self.assertFalse(nothing.ok)
        self.assertEqual(nothing.kind, 'refused')
        self.assertTrue(np.isnan(nothing.position_m).all())

    def test_chosen_place_is_where_the_next_object_starts(self):
        depth = np.full((HEIGHT, WIDTH), 1.5, np.float32)
        depth[60:180, 40:120], depth[60:180, 200:280] = 0.5, 0.7
        tracker = disflow.Tracker()
        self.assertAlmostEqual(tracker.process(depth, CAMERA, 1).position_m[2], 0.5, places=2)
        tracker.choose_pixel(290, 120, reach_px=11)
        self.assertAlmostEqual(tracker.process(depth, CAMERA, 2).position_m[2], 0.7, places=2)
        tracker.choose_box(30, 50, 100, 140)
        self.assertAlmostEqual(tracker.process(depth, CAMERA, 3).position_m[2], 0.5, places=2)
        for wrong in (lambda: tracker.choose_pixel(-1, 5), lambda: tracker.choose_box(0, 0, 0, 5)):
            with self.assertRaisesRegex(ValueError, 'no image'):
                wrong()

    def test_rows_that_are_not_adjacent_are_read_in_place(self):
        wide = np.zeros((HEIGHT, 2 * WIDTH), np.float32)
        wide[:, :WIDTH] = depth_at(0.0)
        a = disflow.Tracker().process(wide[:, :WIDTH], CAMERA, 1)
        b = disflow.Tracker().process(depth_at(0.0), CAMERA, 1)
        np.testing.assert_array_equal(a.position_m, b.position_m)

    def test_pose_in_the_world_is_that_of_the_camera_times_that_of_the_object(self):
        T_wc = np.eye(4)
        T_wc[:3, 3] = [1, 2, 3]
        e = disflow.Tracker().process(depth_at(0.0), CAMERA, 1, T_wc=T_wc)
        np.testing.assert_allclose(e.T_wo, T_wc @ e.T_co, atol=1e-6)
        self.assertIsNone(disflow.Tracker().process(depth_at(0.0), CAMERA, 1).T_wo)

    def test_reset_starts_another_object(self):
        tracker, estimates = tracked(2)
        tracker.reset()
        again = tracker.process(depth_at(0.1), CAMERA, stamp_at(3))
        self.assertNotEqual(again.reset_counter, estimates[-1].reset_counter)

    def test_frames_with_known_poses_build_a_model(self):
        tracker = disflow.Tracker()
        for i in range(4):
            e = tracker.fuse(depth_at(i / 30), CAMERA, stamp_at(i), np.linalg.inv(pose_at(i / 30)))
        self.assertTrue(e.ok)
        points, normals, _, observations = tracker.samples()
        self.assertLess(np.abs(points).max(0)[0], HALF_BOX_M[0] + 0.003)
        self.assertEqual(len(points), len(normals))
        self.assertGreater(observations.max(), 2)


class Model(unittest.TestCase):
    def setUp(self):
        self.tracker, estimates = tracked()
        # From the object frame to the box.
        self.T_bo = np.linalg.inv(pose_at((FRAMES - 1) / 30)) @ estimates[-1].T_co

    def test_mesh_lies_on_the_box(self):
        vertices, triangles, normals, std_m = self.tracker.mesh()
        self.assertGreater(len(triangles), 1000)
        self.assertEqual(triangles.dtype, np.int32)
        self.assertEqual(len(np.unique(vertices, axis=0)), len(vertices))
        self.assertTrue((0 <= triangles).all() and triangles.max() == len(vertices) - 1)
        inside = np.abs(vertices @ self.T_bo[:3, :3].T + self.T_bo[:3, 3]) - HALF_BOX_M
        distance = np.linalg.norm(np.maximum(inside, 0), axis=1) + np.minimum(inside.max(1), 0)
        self.assertLess(np.quantile(np.abs(distance), 0.95), 0.002)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-3)
        self.assertTrue((std_m > 0).all())

    def test_mesh_of_open3d_is_the_same(self):
        try:
            import open3d
        except ImportError:
            self.skipTest('open3d is not installed (python3-open3d)')
        vertices, triangles, normals, _ = self.tracker.mesh()
        mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(vertices),
                                            open3d.utility.Vector3iVector(triangles))
        np.testing.assert_array_equal(np.asarray(mesh.vertices, np.float32), vertices)
        self.assertTrue(mesh.is_edge_manifold(allow_boundary_edges=True))
        # Outward by the order of their corners as by the normals that come with them.
        mesh.compute_triangle_normals()
        agree = (np.asarray(mesh.triangle_normals) * normals[triangles[:, 0]]).sum(1)
        self.assertGreater(np.mean(agree > 0.5), 0.98)

    def test_distance_of_a_point_off_a_face_is_what_it_is_off(self):
        # 1 cm off the middle of the face that the camera sees best.
        faces = np.array([[0, 0, -1], [0, -1, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        R_cb = pose_at((FRAMES - 1) / 30)[:3, :3]
        normal = min(faces, key=lambda n: (R_cb @ n)[2])
        on_box = np.append(normal * (HALF_BOX_M + 0.01), 1.0)
        point = (np.linalg.inv(self.T_bo) @ on_box)[None, :3]
        distance, gradient, variance, in_bounds = self.tracker.query(point)
        self.assertAlmostEqual(float(distance[0]), 0.01, delta=0.001)
        np.testing.assert_allclose(gradient[0], self.T_bo[:3, :3].T @ normal, atol=0.1)
        self.assertGreater(variance[0], 0)
        self.assertTrue(in_bounds[0])

    def test_point_that_is_not_finite_has_no_distance(self):
        distance, gradient, _, in_bounds = self.tracker.query([[0, 0, np.nan], [0, 0, 0.1]])
        self.assertTrue(np.isnan(distance[0]) and np.isnan(gradient[0]).all() and not in_bounds[0])
        self.assertTrue(np.isfinite(distance[1]))

    def test_object_mask_shows_the_box(self):
        mask = self.tracker.object_mask()
        truth = depth_at((FRAMES - 1) / 30) < 1.0
        self.assertEqual(mask.shape, truth.shape)
        self.assertGreater(((mask == 255) & truth).sum(), 0.95 * truth.sum())
        self.assertLess(((mask == 255) & ~truth).sum(), 0.02 * truth.sum())

    def test_model_of_nothing_is_empty(self):
        empty = disflow.Tracker('micro')
        self.assertEqual([len(part) for part in empty.mesh()], [0, 0, 0, 0])
        self.assertEqual(len(empty.samples()[0]), 0)
        self.assertEqual(empty.object_mask().size, 0)
        with self.assertRaises(RuntimeError):
            empty.query([[0, 0, 0]])


class Arrays(unittest.TestCase):
    def test_of_an_estimate_are_views_that_keep_it_alive(self):
        _, estimates = tracked(3)
        covariance, position = estimates[-1].pose_covariance, estimates[-1].position_m
        self.assertIs(covariance.base, estimates[-1])
        self.assertFalse(covariance.flags.owndata or covariance.flags.writeable)
        kept = covariance.copy(), position.copy()
        del estimates
        gc.collect()
        np.testing.assert_array_equal(covariance, kept[0])
        np.testing.assert_array_equal(position, kept[1])
        self.assertEqual(covariance.shape, (6, 6))
        np.testing.assert_allclose(covariance, covariance.T, rtol=1e-4, atol=1e-12)

    def test_that_would_have_to_be_copied_are_refused(self):
        tracker = disflow.Tracker()
        depth = depth_at(0.0)
        for wrong in (depth.astype(np.float64), depth[:, ::2], depth.T, depth[None], depth[::-1]):
            with self.assertRaisesRegex(TypeError, 'depth'):
                tracker.process(wrong, CAMERA, 1)
        for wrong in (depth, (depth < 1.0)[:, ::2], (depth < 1.0).astype(np.int32)):
            with self.assertRaisesRegex(TypeError, 'mask'):
                tracker.process(depth, CAMERA, 1, mask=wrong)
        with self.assertRaisesRegex(ValueError, 'as large as depth'):
            tracker.process(depth, CAMERA, 1, mask=np.ones((3, 3), np.uint8))

    def test_that_are_no_rigid_motion_are_refused(self):
        scaled, mirrored, unfinished = 2 * np.eye(4), np.diag([1, 1, -1, 1]), np.full((4, 4), np.nan)
        for wrong in (scaled, mirrored, unfinished, np.eye(3)):
            with self.assertRaisesRegex(ValueError, 'T_wc'):
                disflow.Tracker().process(depth_at(0.0), CAMERA, 1, T_wc=wrong)
            with self.assertRaisesRegex(ValueError, 'T_oc'):
                disflow.Tracker().fuse(depth_at(0.0), CAMERA, 1, wrong)

    def test_that_the_profile_cannot_hold_are_refused_in_the_estimate(self):
        e = disflow.Tracker('micro').process(np.ones((2000, 3000), np.float32), CAMERA, 1)
        self.assertEqual((e.kind, e.ok), ('refused', False))
        self.assertIn('image', e.status_text)


class Settings(unittest.TestCase):
    def test_are_listed_with_what_they_mean(self):
        border = disflow.settings()['sampler.border_px']
        self.assertEqual((border['unit'], border['min']), ('px', 0))
        self.assertIsInstance(border['default'], int)
        self.assertIn('outline', border['meaning'])

    def test_each_takes_its_default(self):
        everything = {name: entry['default'] for name, entry in disflow.settings().items()}
        _, plain = tracked(3)
        _, same = tracked(3, settings=everything)
        np.testing.assert_array_equal(plain[-1].position_m, same[-1].position_m)

    def test_that_cannot_be_are_refused_by_name(self):
        with self.assertRaisesRegex(KeyError, 'sampler.colour'):
            disflow.Tracker(settings={'sampler.colour': 1})
        with self.assertRaisesRegex(ValueError, 'sampler.border_px: allowed are whole numbers from 0'):
            disflow.Tracker(settings={'sampler.border_px': 99})
        with self.assertRaisesRegex(ValueError, 'sampler.border_px'):
            disflow.Tracker(settings={'sampler.border_px': 1.5})
        with self.assertRaisesRegex(ValueError, 'micro, edge or dense'):
            disflow.Tracker('huge')


class Threads(unittest.TestCase):
    def test_two_trackers_in_two_threads_give_what_one_gives(self):
        _, expected = tracked(8)
        results = {}
        threads = [threading.Thread(target=lambda i=i: results.update({i: tracked(8)[1][-1]})) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i in range(2):
            np.testing.assert_array_equal(results[i].position_m, expected[-1].position_m)

    def test_one_tracker_in_two_threads_takes_one_call_after_another(self):
        tracker, _ = tracked(2)
        counts = []

        def work():
            for _ in range(20):
                tracker.process(depth, CAMERA, 1)  # refused: the stamp does not increase
                counts.append(len(tracker.samples()[0]))

        depth = depth_at(0.0)
        threads = [threading.Thread(target=work) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(counts)), 1)


if __name__ == '__main__':
    unittest.main()
