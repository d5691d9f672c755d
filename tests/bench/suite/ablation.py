# SPDX-License-Identifier: BSD-3-Clause
"""The ablation table: what each part of the method brings."""

import dataclasses

import pages
import runs
from figures import FIGURES, Summary


@dataclasses.dataclass(frozen=True)
class Variant:
    """The method with one part switched off or replaced."""

    name: str
    settings: tuple = ()


WHOLE = Variant("as shipped")
VARIANTS = (
    WHOLE,
    # Registration.
    Variant("one start: the predicted pose", ("registration.hypothesis_score=0",)),
    Variant("no occluding edges", ("sampler.edge_background_gap_m=10",)),
    Variant("nearly least squares: kernel 20 σ wide", ("registration.robust_scale_sigmas=20",)),
    Variant("no graduated non-convexity: kernel narrow at once", ("registration.robust_scale_start_m=0.0001",)),
    Variant("no gate on normals", ("registration.min_normal_cos=-1",)),
    Variant("no temporal regulariser", ("registration.temporal_std_m=10", "registration.temporal_std_rad=10")),
    Variant("damping of 0.01 diag(H)", ("registration.damping=0.01",)),
    # Sampling.
    Variant("samples weighed alike: σ at least 1 mm", ("sampler.sample_floor_m=0.001",)),
    Variant("sensor noise given, not estimated", ("sampler.inverse_depth_std_per_m=0.0024",)),
    Variant("curved windows taken for clutter", ("sampler.max_bend_ratio=0",)),
    # Field.
    Variant("no averaging: the first observation stays", ("field.freeze_after=1",)),
    Variant("no freezing", ("field.freeze_after=250",)),
    Variant("no overlap of local GPs", ("field.overlap_m=0",)),
    Variant("no clusters per side of a crease", ("field.crease_cos=0",)),
    Variant("local plane alone: stiff prior", ("field.prior_gradient_std=0.01",)),
    Variant("length scale of one cell, 2 cm", ("field.length_scale_m=0.02",)),
    # Twist.
    Variant("twist from pose differences: any acceleration",
            ("twist.linear_jerk_psd=1e7", "twist.angular_jerk_psd=1e9")),
)

SCENES = {
    f"{thing}, {motion}, {noise}": f"{thing}?motion={motion}&noise={noise}"
    for motion, noise in (("fast", "clean"), ("fast", "d415"), ("flying", "d415"))
    for thing in ("box", "bottle")
}


def _mean_over(summaries, figure):
    """Mean over several scenes; None if one of them lacks it."""
    values = [summary.mean(figure) for summary in summaries]
    return None if None in values else sum(values) / len(values)


def measure(programs, variants, seeds):
    """Runs everything. @return The table."""
    jobs = [
        runs.Job(variant.name, scene, seed, variant.settings)
        for variant in variants
        for scene in SCENES.values()
        for seed in seeds
    ]
    by_cell = {}
    for job, run in runs.run_all(jobs, programs.track).items():
        by_cell.setdefault((job.name, job.scene), {})[job.seed] = run
    head = ["variant"] + [f"{name}: ADD-AUC %" for name in SCENES]
    head += ["fast, d415: e_t mm", "v cm/s", "ω °/s", "median ms", "settings"]
    noisy = [name for name in SCENES if name.endswith("fast, d415")]
    lines = []
    for variant in variants:
        summaries = {name: Summary(by_cell[variant.name, scene]) for name, scene in SCENES.items()}
        line = [variant.name]
        line += [FIGURES["add_auc"].show(summary.mean("add_auc")) for summary in summaries.values()]
        for figure in ("e_t", "v", "w", "median_ms"):
            line.append(FIGURES[figure].show(_mean_over([summaries[name] for name in noisy], figure)))
        line.append(" ".join(f"`{setting}`" for setting in variant.settings) or "–")
        lines.append(line)
    seed_text = pages.name_seeds(seeds)
    note = f"Means over {seed_text}, 300 frames each; the four figures on the right are means over box and bottle. "
    note += "Times were taken with several runs at once and only compare with each other."
    return note + "\n\n" + pages.table(head, lines)
