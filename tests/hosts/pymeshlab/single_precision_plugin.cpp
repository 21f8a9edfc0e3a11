// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that says that it was built for MeshLab in single precision.
#include <QObject>
#include <QString>
#include <string>
#include <utility>

#include "common/plugins/interfaces/meshlab_plugin.h"

class SinglePrecisionPlugin : public QObject, public MeshLabPlugin {
    Q_OBJECT
    Q_PLUGIN_METADATA(IID "tracked_mcf.single_precision")

public:
    std::pair<std::string, bool> getMLVersion() const override { return {"2025.07", false}; }
    QString pluginName() const override { return "SinglePrecision"; }
};

#include "single_precision_plugin.moc"
