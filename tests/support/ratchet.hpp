#pragma once

#include <string_view>

namespace strutt::test {

/// Checks observed <= allowed and hands both to the ratchet (tests/accuracy/accuracy.py), which fails when
/// `allowed` is more than 8 times the worst that was ever observed. `what` says what is measured and is the
/// same in every run; one that belongs to an extreme begins with its row, "N06 width, relative". No commas.
/// The test case has the tag [ratchet], and that of the row.
void check_within(std::string_view what, double observed, double allowed);

/// The same for the relative difference |value/expected - 1|, 0 where both are equal.
void check_close(std::string_view what, double value, double expected, double allowed);

}  // namespace strutt::test
