// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a MeshLab that has loaded two builds of the plugin, as if a file of an earlier version lay
// beside the new one. The second is a copy of the file, which the loader treats like any other
// file.

#include <dlfcn.h>

#include <QFile>
#include <QTemporaryDir>

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

/// A copy of the plugin's file in a temporary folder.
class CopiedFile {
public:
    CopiedFile() {
        EXPECT_TRUE(QFile::copy(TRACKED_MCF_PLUGIN_FILE, QString::fromStdString(path())));
    }
    std::string path() const {
        return folder_.filePath("libfilter_tracked_mcf_2.so").toStdString();
    }

private:
    QTemporaryDir folder_;
};

const host::Filter& other_build() {
    static const CopiedFile file;
    static const host::Filter filter(file.path());
    return filter;
}

TEST_F(Plugin, BuildsThatRunAtOnceShareNothing) {
    MeshDocument other;
    MeshModel& same = host::add_layer(other, "same");
    make_layer(same);
    action_percent = 0;
    action = [&] { EXPECT_TRUE(other_build().apply(other, parameters).succeeded); };
    ASSERT_TRUE(apply(process_events)) << outcome.message;
    EXPECT_EQ(position_bits(layer), position_bits(same));
}

TEST_F(Plugin, ABuildKeepsWhatTheOtherWroteMeanwhile) {
    std::vector<PositionBits> written;
    action_percent = 0;
    action = [&] {
        EXPECT_TRUE(other_build().apply(document, parameters).succeeded);
        written = position_bits(layer);
    };
    EXPECT_FALSE(apply(process_events));
    EXPECT_TRUE(contains(outcome.message, "changed")) << outcome.message;
    EXPECT_EQ(position_bits(layer), written);
}

TEST(PluginFile, CanBeUnloadedSoThatANewerOneCanReplaceIt) {
    const CopiedFile file;
    for (int i = 0; i < 3; ++i) {
        void* const plugin = dlopen(file.path().c_str(), RTLD_NOW);
        ASSERT_NE(plugin, nullptr) << dlerror();
        EXPECT_EQ(dlclose(plugin), 0);
        EXPECT_EQ(dlopen(file.path().c_str(), RTLD_NOW | RTLD_NOLOAD), nullptr) << "still loaded";
    }
}

}  // namespace

}  // namespace tracked_mcf
