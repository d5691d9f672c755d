// SPDX-License-Identifier: BSD-3-Clause
// What the library has of the shipped profiles, for a profile of one's own.
#include "own_profile.h"

#include "disflow/field/distance_query.h"
#include "disflow/surface_extractor_impl.h"
#include "disflow/tracker_impl.h"

namespace disflow {

template class Tracker<consumer::OwnProfile>;
template class DistanceQuerier<consumer::OwnProfile>;
template Expected<SurfaceCounts> ExtractSurface(const DistanceField<consumer::OwnProfile>&,
                                                const SurfaceOptions&,
                                                SurfaceWorkspace<consumer::OwnProfile>&,
                                                TriangleSink&) noexcept;

}  // namespace disflow
