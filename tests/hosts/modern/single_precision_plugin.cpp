// SPDX-License-Identifier: GPL-3.0-or-later
#include "single_precision_plugin.h"

namespace tracked_mcf {

std::pair<std::string, bool> SinglePrecisionPlugin::getMLVersion() const {
    return {"2025.07", false};
}

QString SinglePrecisionPlugin::pluginName() const {
    return "SinglePrecision";
}

}  // namespace tracked_mcf
