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
    Variant("one start only (no hypotheses)", ("registration.hypothesis_score=0",)),
    Variant("no occluding edges", ("registration.edge_std_px=100",)),
    Variant("no robust kernel", ("registration.robust_scale_start_m=1", "registration.robust_scale_sigmas=20")),
    Variant("robust kernel without graduated non-convexity", ("registration.robust_scale_start_m=0.0001",)),
    Variant("all samples weighed alike", ("sampler.sample_floor_m=0.005",)),
    Variant("sensor noise not estimated", ("sampler.inverse_depth_std_per_m=0.0001",)),
    Variant("no averaging (first observation stays)", ("field.freeze_after=1", "field.mature_after=1")),
    Variant("no freezing", ("field.freeze_after=250",)),
    Variant("every sample trained on at once", ("field.mature_after=1",)),
    Variant("no overlap of the local GPs", ("field.overlap_m=0",)),
    Variant("no clusters per side of a crease", ("field.crease_cos=0",)),
    Variant("short length scale (2 cm)", ("field.length_scale_m=0.02",)),
    Variant("no temporal prior", ("registration.temporal_std_m=10", "registration.temporal_std_rad=10")),
    Variant("four iterations", ("registration.iterations=4",)),
)

SCENES = {
    "box, fast, clean": "box?motion=fast&noise=clean",
    "box, fast, d415": "box?motion=fast&noise=d415",
    "bottle, fast, d415": "bottle?motion=fast&noise=d415",
    "box, flying, d415": "box?motion=flying&noise=d415",
    "bottle, flying, d415": "bottle?motion=flying&noise=d415",
}


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
    head = ["variant"] + [f"{name}: ADD-AUC % / e_t mm" for name in SCENES] + ["settings"]
    lines = []
    for variant in variants:
        line = [variant.name]
        for scene in SCENES.values():
            summary = Summary(by_cell[variant.name, scene])
            line.append(" / ".join(FIGURES[figure].show(summary.mean(figure)) for figure in ("add_auc", "e_t")))
        line.append(" ".join(f"`{setting}`" for setting in variant.settings) or "–")
        lines.append(line)
    seed_text = f"seeds 1 to {len(seeds)}" if len(seeds) > 1 else "seed 1"
    return f"Means over {seed_text}, 300 frames each.\n\n" + pages.table(head, lines)
