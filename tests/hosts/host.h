// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QVariant>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "meshlab_api.h"

/// Runs filters with a MeshLab release's common library, without a display and without its
/// programs. release.h and release.cpp contain the differences between releases: legacy is MeshLab
/// 2020.09, modern is 2022.02 and later, and PyMeshLab.
namespace tracked_mcf::host {

/// A filter's description of itself.
struct Declaration {
    std::string name, python_name, help;
    std::string built_for;  ///< version and precision, such as "2025.07d double"
    bool smooths, takes_one_layer;
    int requirements, post_condition;
};

/// The result of a run of a filter.
struct Outcome {
    bool succeeded;
    std::string message;  ///< the error of a failure
    std::string log;      ///< all lines
    std::map<std::string, QVariant> outputs;
};

/// A filter of a plugin: the first, or the one of a name. The plugin is loaded with the checks of
/// this release. Throws std::runtime_error with the host's message if it cannot be loaded.
class Filter {
public:
    explicit Filter(const std::string& plugin_file, const std::string& name = {});
    ~Filter();
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    Declaration declaration() const;
    /// Returns the number of the plugin's filters.
    std::ptrdiff_t filters_in_plugin() const;
    bool is_applicable(const MeshModel& layer) const;
    /// Returns the parameters with the dialog's defaults.
    RichParameterList parameters(MeshDocument& document) const;
    /// Adds the attributes that the filter requires to the current layer, then applies the filter.
    Outcome apply(MeshDocument& document, const RichParameterList& parameters,
                  vcg::CallBackPos* callback = nullptr) const;

private:
    struct Loaded;
    std::unique_ptr<Loaded> loaded_;
};

/// Adds an empty layer and makes it the current one.
MeshModel& add_layer(MeshDocument& document, const char* label);

/// Deletes a layer. As in MeshLab, the first of the others becomes the current one.
void delete_layer(MeshDocument& document, MeshModel& layer);

void hide(MeshModel& layer);

/// Enables the attributes of a vcg::tri::io::Mask in the layer.
void make_room(MeshModel& layer, int io_mask);

/// Returns the value of a choice.
std::unique_ptr<Value> choice(int index);

/// Sets a parameter that is a length. Its type of value differs between releases.
void set_length(RichParameterList& parameters, const QString& name, float length);

}  // namespace tracked_mcf::host
