// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/surface_extractor_impl.h"

namespace disflow {

template Expected<SurfaceCounts> ExtractSurface(const DistanceField<profiles::Micro>&,
                                                const SurfaceOptions&,
                                                SurfaceWorkspace<profiles::Micro>&,
                                                TriangleSink&) noexcept;
template Expected<SurfaceCounts> ExtractSurface(const DistanceField<profiles::Edge>&,
                                                const SurfaceOptions&,
                                                SurfaceWorkspace<profiles::Edge>&,
                                                TriangleSink&) noexcept;
template Expected<SurfaceCounts> ExtractSurface(const DistanceField<profiles::Dense>&,
                                                const SurfaceOptions&,
                                                SurfaceWorkspace<profiles::Dense>&,
                                                TriangleSink&) noexcept;

}  // namespace disflow
