// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/presentation/report_table.h"
#include "tests/zoo/zoo_case.h"

namespace tracked_mcf::zoo {

/// What running a case gave.
struct Run {
    TriangleMesh mesh;
    FlowReport report;  ///< for another filter, as far as it says the same
    ReportObject values;
    std::string refusal;  ///< message of an exception of errors.h
    std::string foreign;  ///< message of any other exception
    double cpu_seconds = 0;
    bool is_loss_told = true;  ///< whether the removal of noise warns that parts have shrunk
    bool made() const { return refusal.empty() && foreign.empty(); }
};

/// Runs the filter of a case.
Run run(const Case& run_case, int threads = 1);

/// Returns, per vertex, whether a selected triangle uses it.
std::vector<bool> vertices_of(const TriangleMesh& mesh, const Selection& selection);

/// Returns the bounding box of some vertices.
Eigen::AlignedBox3d box_of(const TriangleMesh& mesh, const std::vector<bool>& vertices);

/// Returns a number as messages give it.
std::string number(double value);

}  // namespace tracked_mcf::zoo
