// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPointer>

class QAbstractButton;
class QDockWidget;

namespace tracked_mcf {

/// Guards MeshLab's dialog of a filter while the filter runs.
///
/// MeshLab's progress callback processes the user's events, but the dialog does not expect them
/// during a run: it would restore the layer, or take an unfinished layer for the result. The guard
/// lets all events pass except these:
/// - A click on *Preview*, *Apply* or *Close* waits until the run has ended. It ends a preview at
///   once. A second click on *Apply* is ignored.
/// - Esc ends every run, and unticks *Preview*.
///
/// Does nothing in a host that has no such dialog. Esc works without a dialog, too.
class FilterDialog : public QObject {
public:
    explicit FilterDialog(const char* filter_name);
    /// Queues what has waited. MeshLab does it after the filter has returned.
    ~FilterDialog() override;

    /// Returns whether the run must end and leave the layer as it is.
    bool ends_run() const { return ends_run_; }
    /// Returns whether *Apply* has started the run, rather than a preview.
    bool applies() const { return applies_; }
    /// Begins a preview after the run.
    void preview_afterwards() { preview_afterwards_ = true; }

    bool eventFilter(QObject* receiver, QEvent* event) override;

private:
    QAbstractButton* button(const char* text) const;
    void click_afterwards(QAbstractButton* button);

    QPointer<QDockWidget> dialog_;
    QPointer<QAbstractButton> clicked_;
    bool applies_ = false, ends_run_ = false, preview_afterwards_ = false;
};

}  // namespace tracked_mcf
