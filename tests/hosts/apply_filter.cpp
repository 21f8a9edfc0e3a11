// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a filter of the plugin on a PLY file in a host without a display:
// apply_filter PLUGIN FILTER IN.ply OUT.ply [NAME=VALUE]...
//
// Other parameters have the dialog's defaults. The value of a choice is its index. Prints the
// host's log. Exits with 1 and the filter's message if the filter fails.

#include <vcg/complex/complex.h>
#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/import_ply.h>

#include <QApplication>
#include <iostream>
#include <stdexcept>

#include "tests/hosts/host.h"

namespace tracked_mcf {

namespace {

using vcg::tri::io::ExporterPLY;
using vcg::tri::io::ImporterPLY;

void read(const char* file, MeshModel& layer) {
    int mask = 0;
    ImporterPLY<CMeshO>::LoadMask(file, mask);
    host::make_room(layer, mask);
    const int error = ImporterPLY<CMeshO>::Open(layer.cm, file, mask);
    if (error != 0) throw std::runtime_error(ImporterPLY<CMeshO>::ErrorMsg(error));
    update_box_and_normals(layer);
}

void write(const char* file, MeshModel& layer) {
    const int error =
        ExporterPLY<CMeshO>::Save(layer.cm, file, vcg::tri::io::Mask::IOM_VERTQUALITY);
    if (error != 0) throw std::runtime_error(ExporterPLY<CMeshO>::ErrorMsg(error));
}

/// Parses a value of the parameter's type.
void set(RichParameterList& list, const QString& name, const QString& value) {
    if (!list.hasParameter(name)) throw std::runtime_error("no parameter " + name.toStdString());
    const RichParameter& parameter = list.getParameterByName(name);
    const QString type = parameter.stringType();
    if (type == "RichInt") list.setValue(name, IntValue(value.toInt()));
    if (type == "RichAbsPerc") host::set_length(list, name, value.toFloat());
    if (type == "RichFloat") list.setValue(name, FloatValue(value.toFloat()));
    if (type == "RichBool") list.setValue(name, BoolValue(value == "true"));
    if (type == "RichEnum") list.setValue(name, *host::choice(value.toInt()));
}

void print(const host::Outcome& outcome) {
    std::cout << outcome.log << '\n';
    for (const auto& [name, value] : outcome.outputs) {
        std::cout << name << " = " << value.toString().toStdString() << '\n';
    }
}

void run(const QStringList& arguments) {
    if (arguments.size() < 5) {
        throw std::runtime_error("usage: PLUGIN FILTER IN.ply OUT.ply [NAME=VALUE]...");
    }
    const host::Filter filter(arguments[1].toStdString(), arguments[2].toStdString());
    MeshDocument document;
    MeshModel& layer = host::add_layer(document, "layer");
    read(qUtf8Printable(arguments[3]), layer);
    RichParameterList parameters = filter.parameters(document);
    for (const QString& setting : arguments.mid(5)) {
        set(parameters, setting.section('=', 0, 0), setting.section('=', 1));
    }
    const host::Outcome outcome = filter.apply(document, parameters);
    if (!outcome.succeeded) throw std::runtime_error(outcome.message);
    print(outcome);
    write(qUtf8Printable(arguments[4]), layer);
}

}  // namespace

}  // namespace tracked_mcf

int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    try {
        tracked_mcf::run(application.arguments());
    } catch (const std::exception& error) {
        std::cerr << "apply_filter: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
