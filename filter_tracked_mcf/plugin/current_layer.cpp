#include "filter_tracked_mcf/plugin/current_layer.h"

#include "filter_tracked_mcf/plugin/rich_parameters.h"

namespace tracked_mcf {

FilterOutcome smooth_current_layer(MeshDocument& document, const RichParameterList& parameters,
                                   vcg::CallBackPos* callback) {
    return guard([&] {
        MeshModel* const layer = document.mm();
        if (layer == nullptr) throw InvalidMesh("There is no layer to smooth; open a mesh first.");
        FilterOutcome outcome = run_filter(layer->cm, read_values(parameters), callback);
        update_box_and_normals(*layer);
        return outcome;
    });
}

}  // namespace tracked_mcf
