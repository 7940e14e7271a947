#pragma once

#include <string>
#include <utility>
#include <vector>

namespace strutt {

/// Where a result came from: ordered name/value pairs, written into every file. No host name, no user name.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// program, version, compiler, library versions, date in UTC (SOURCE_DATE_EPOCH honoured), and `command` if
/// not empty.
Provenance make_provenance(const std::string& command = {});

/// As comment lines of a text file, "# name: value"; further lines of a value are indented below the first.
std::string comment_lines(const Provenance& provenance);

/// As a JSON object (UTF-8; other bytes become U+FFFD), on one line.
std::string json_text(const Provenance& provenance);

/// "0.1.0 (SUNDIALS 6.4.1, Eigen 3.4.0, ...)" for --version.
std::string version_text();

}  // namespace strutt
