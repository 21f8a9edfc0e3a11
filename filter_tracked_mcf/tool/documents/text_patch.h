#pragma once

#include <ostream>
#include <string_view>

namespace tracked_mcf {

/// Writes a text with some parts of it replaced, given in the order in which they stand there.
class TextPatch {
public:
    TextPatch(std::ostream& out, std::string_view text) : out_(out), rest_(text) {}

    /// Writes everything up to `part`, a view into the text, and then `replacement`.
    void replace(std::string_view part, std::string_view replacement) {
        const auto before = static_cast<std::size_t>(part.data() - rest_.data());
        out_ << rest_.substr(0, before) << replacement;
        rest_.remove_prefix(before + part.size());
    }

    /// Writes what remains.
    void finish() { out_ << rest_; }

private:
    std::ostream& out_;
    std::string_view rest_;
};

}  // namespace tracked_mcf
