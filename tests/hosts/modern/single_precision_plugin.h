// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/plugins/interfaces/meshlab_plugin.h>

#include <QObject>
#include <QString>
#include <string>
#include <utility>

namespace tracked_mcf {

/// A plugin that says that it was built for MeshLab 2025.07 in single precision.
class SinglePrecisionPlugin : public QObject, public MeshLabPlugin {
    Q_OBJECT
    Q_PLUGIN_METADATA(IID "tracked_mcf.single_precision")

public:
    std::pair<std::string, bool> getMLVersion() const override;
    QString pluginName() const override;
};

}  // namespace tracked_mcf
