// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"
#include "tests/zoo/random.h"

namespace tracked_mcf::zoo {

/// A kind of mesh that is hard to smooth, and a generator of random ones. They have at most a few
/// thousand triangles, and the size of about 1 unless the kind is one of size.
struct Kind {
    std::string name;
    TriangleMesh (*make)(Random& random);
};

/// Returns all kinds.
const std::vector<Kind>& kinds();

}  // namespace tracked_mcf::zoo
