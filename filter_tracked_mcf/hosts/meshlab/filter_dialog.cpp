// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/meshlab/filter_dialog.h"

#include <QAbstractButton>
#include <QApplication>
#include <QDockWidget>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QThread>

namespace tracked_mcf {

namespace {

QDockWidget* find_dialog(const QString& title) {
    const QWidgetList widgets = QApplication::allWidgets();
    for (QWidget* widget : widgets) {
        auto* const dialog = qobject_cast<QDockWidget*>(widget);
        if (dialog != nullptr && dialog->isVisible() && dialog->windowTitle() == title) {
            return dialog;
        }
    }
    return nullptr;
}

/// Returns the key of a press, or 0. Before a press, Qt asks whether it is a shortcut.
int pressed_key(const QEvent& event) {
    const bool is_key =
        event.type() == QEvent::KeyPress || event.type() == QEvent::ShortcutOverride;
    return is_key ? static_cast<const QKeyEvent&>(event).key() : 0;
}

bool clicks(const QEvent& event) {
    if (event.type() == QEvent::MouseButtonPress || event.type() == QEvent::MouseButtonDblClick) {
        return static_cast<const QMouseEvent&>(event).button() == Qt::LeftButton;
    }
    const int key = pressed_key(event);
    return key == Qt::Key_Space || key == Qt::Key_Return || key == Qt::Key_Enter;
}

}  // namespace

FilterDialog::FilterDialog(const char* filter_name) {
    // PyMeshLab has no application, and meshlabserver no dialog.
    const auto* const application = qobject_cast<QApplication*>(QCoreApplication::instance());
    if (application == nullptr || QThread::currentThread() != application->thread()) return;
    dialog_ = find_dialog(filter_name);
    // A clicked button has the focus. Neither release tells a filter whether it runs for a preview.
    applies_ = dialog_ && dialog_->focusWidget() == button("Apply");
    QCoreApplication::instance()->installEventFilter(this);
}

FilterDialog::~FilterDialog() {
    if (clicked_) QMetaObject::invokeMethod(clicked_, "click", Qt::QueuedConnection);
    if (dialog_ && preview_afterwards_) {
        QMetaObject::invokeMethod(dialog_, "applyDynamic", Qt::QueuedConnection);
    }
}

QAbstractButton* FilterDialog::button(const char* text) const {
    const auto buttons = dialog_->findChildren<QAbstractButton*>();
    for (QAbstractButton* button : buttons) {
        if (button->text().remove('&') == text) return button;  // A desktop may mark a letter.
    }
    return nullptr;
}

void FilterDialog::click_afterwards(QAbstractButton* button) {
    clicked_ = button;
    ends_run_ = ends_run_ || !applies_;
}

bool FilterDialog::eventFilter(QObject* receiver, QEvent* event) {
    // Esc in a list of choices or in a message is for that window.
    if (pressed_key(*event) == Qt::Key_Escape && receiver->isWindowType() &&
        QApplication::activePopupWidget() == nullptr &&
        QApplication::activeModalWidget() == nullptr) {
        ends_run_ = true;
        QAbstractButton* const preview = dialog_ ? button("Preview") : nullptr;
        if (preview != nullptr && preview->isChecked()) clicked_ = preview;
        event->accept();
        return true;
    }
    if (!dialog_) return false;
    if (receiver == dialog_ && event->type() == QEvent::Close) {
        click_afterwards(button("Close"));
        event->ignore();
        return true;
    }
    if (!clicks(*event)) return false;
    for (const char* const text : {"Preview", "Apply", "Close"}) {
        if (receiver != button(text)) continue;
        if (receiver != button("Apply") || !applies_) {
            click_afterwards(static_cast<QAbstractButton*>(receiver));
        }
        event->accept();
        return true;
    }
    return false;
}

}  // namespace tracked_mcf
