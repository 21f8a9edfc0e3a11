#pragma once

#include <QVariant>
#include <map>
#include <memory>
#include <string>

#include "meshlab_api.h"

/// What the tests need of a MeshLab release: its common library, without a display or its programs.
/// What differs between releases is in release.h and release.cpp: legacy is MeshLab 2020.09, modern
/// 2022.02 and later, and PyMeshLab.
namespace tracked_mcf::host {

/// What a filter says of itself.
struct Declaration {
    std::string name, python_name, help;
    std::string built_for;  ///< version and precision, such as "2025.07d double"
    bool smooths, takes_one_layer;
    int requirements, post_condition;
};

/// How a run of a filter ended.
struct Outcome {
    bool succeeded;
    std::string message;  ///< the error of a failure
    std::string log;      ///< all lines
    std::map<std::string, QVariant> outputs;
};

/// A filter of a plugin, loaded with the checks that this release makes. The first one, or the one
/// of that name. Throws std::runtime_error with the host's own words if it cannot be loaded.
class Filter {
public:
    explicit Filter(const std::string& plugin_file, const std::string& name = {});
    ~Filter();
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    Declaration declaration() const;
    /// How many filters the plugin has.
    int filters_in_plugin() const;
    bool is_applicable(const MeshModel& layer) const;
    /// As a dialog starts with them.
    RichParameterList parameters(MeshDocument& document) const;
    /// Gives the current layer what the filter requires, as hosts do, and applies the filter.
    Outcome apply(MeshDocument& document, const RichParameterList& parameters,
                  vcg::CallBackPos* callback = nullptr) const;

private:
    struct Loaded;
    std::unique_ptr<Loaded> loaded_;
};

/// An empty layer, made current.
MeshModel& add_layer(MeshDocument& document, const char* label);

void hide(MeshModel& layer);

/// For what a file with this vcg::tri::io::Mask holds besides positions.
void make_room(MeshModel& layer, int io_mask);

/// The value of a choice.
std::unique_ptr<Value> choice(int index);

}  // namespace tracked_mcf::host
