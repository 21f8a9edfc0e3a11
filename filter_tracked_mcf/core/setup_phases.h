#pragma once

namespace tracked_mcf {

/// What a flow's set-up consists of, in order; what is not asked for is left out.
enum class SetupPhase {
    CheckMesh,
    MeasureSurface,
    FindEdges,
    ChooseGrid,
    ClipTriangles,
    BuildOctree,
    SampleSurface,
    PrepareSolver
};

/// Tells this thread's meter, if it has one, that a phase begins; its span is the whole set-up.
/// Throws what enter_phase() throws.
void enter_setup_phase(SetupPhase phase);

}  // namespace tracked_mcf
