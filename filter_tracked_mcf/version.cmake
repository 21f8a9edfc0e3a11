# SPDX-License-Identifier: GPL-3.0-or-later
# The project's version. In MeshLab's own tree, the project is MeshLab.
set(TRACKED_MCF_VERSION 1.0.0)
