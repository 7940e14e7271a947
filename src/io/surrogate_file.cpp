#include "strutt/io/surrogate_file.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "strutt/base/error.hpp"
#include "strutt/io/output_file.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "strutt surrogate";
constexpr int kSurrogateFormat = 1;

json to_json(const Axis& axis) {
  return {{"parameter", axis.parameter},
          {"from", axis.from},
          {"to", axis.to},
          {"points", axis.points},
          {"scale", axis.scale == AxisScale::linear ? "linear" : "log"}};
}

Axis axis_from(const json& j) {
  return {j.at("parameter"), j.at("from"), j.at("to"), j.at("points"),
          j.at("scale") == "log" ? AxisScale::logarithmic : AxisScale::linear};
}

/// Row by row.
json to_json(const Eigen::MatrixXd& m) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < m.cols(); ++j) row.push_back(m(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

Eigen::MatrixXd matrix_from(const json& rows) {
  const auto columns = static_cast<Eigen::Index>(rows.at(0).size());
  Eigen::MatrixXd m(static_cast<Eigen::Index>(rows.size()), columns);
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    const auto& row = rows.at(static_cast<std::size_t>(i));
    if (static_cast<Eigen::Index>(row.size()) != columns) throw InvalidInput("rows of different lengths");
    for (Eigen::Index j = 0; j < columns; ++j) m(i, j) = row.at(static_cast<std::size_t>(j)).get<double>();
  }
  return m;
}

json to_json(const SurrogateBox& box) {
  json coefficients = json::array();
  for (const auto& c : box.coefficients) coefficients.push_back(to_json(c));
  return {{"low", box.low},
          {"high", box.high},
          {"interpolated", box.interpolated},
          {"exponent", box.exponent},
          {"kappa", box.kappa},
          {"error", box.error},
          {"coefficients", coefficients}};
}

SurrogateBox box_from(const json& j) {
  SurrogateBox box;
  box.low = j.at("low");
  box.high = j.at("high");
  box.interpolated = j.at("interpolated");
  box.exponent = j.at("exponent");
  box.kappa = j.at("kappa");
  if (!box.interpolated) return box;
  box.error = j.at("error").get<std::vector<double>>();
  for (const auto& c : j.at("coefficients")) box.coefficients.push_back(matrix_from(c));
  return box;
}

json to_json(const SurrogateReport& r) {
  return {{"boxes", r.boxes},
          {"boxes_left_out", r.boxes_left_out},
          {"failed_checks", r.failed_checks},
          {"nodes", r.nodes},
          {"checks", r.checks},
          {"largest_check", r.largest_check},
          {"highest_degree", r.highest_degree},
          {"right_hand_sides", r.right_hand_sides}};
}

SurrogateReport report_from(const json& j) {
  return {.boxes = j.at("boxes"),
          .boxes_left_out = j.at("boxes_left_out"),
          .failed_checks = j.at("failed_checks"),
          .nodes = j.at("nodes"),
          .checks = j.at("checks"),
          .largest_check = j.at("largest_check"),
          .highest_degree = j.at("highest_degree"),
          .right_hand_sides = j.at("right_hand_sides")};
}

Surrogate surrogate_from(const json& file, const std::string& name) {
  if (file.at("format") != kFormat || file.at("version") != kSurrogateFormat)
    throw InvalidInput("not a surrogate of version " + std::to_string(kSurrogateFormat));
  SurrogateData data;
  data.scene = parse_scene(file.at("scene").get<std::string>(), name).scene;
  data.x = axis_from(file.at("x"));
  data.y = axis_from(file.at("y"));
  data.tolerance = file.at("tolerance");
  data.kind = file.at("kind") == "half_period" ? SurrogateKind::half_period : SurrogateKind::period;
  if (!file.at("even_phase").is_null()) data.even_phase = file.at("even_phase").get<double>();
  for (const auto& box : file.at("boxes")) data.boxes.push_back(box_from(box));
  data.report = report_from(file.at("report"));
  return Surrogate(std::move(data));
}

}  // namespace

void save_surrogate(const std::filesystem::path& path, const Surrogate& surrogate,
                    const Provenance& provenance) {
  const auto& data = surrogate.data();
  json boxes = json::array();
  for (const auto& box : data.boxes) boxes.push_back(to_json(box));
  const json file{{"format", kFormat},
                  {"version", kSurrogateFormat},
                  {"provenance", json::parse(json_text(provenance))},
                  {"scene", to_toml({.file = "", .scene = data.scene, .chart = {}})},
                  {"x", to_json(data.x)},
                  {"y", to_json(data.y)},
                  {"tolerance", data.tolerance},
                  {"kind", data.kind == SurrogateKind::half_period ? "half_period" : "period"},
                  {"even_phase", data.even_phase ? json(*data.even_phase) : json()},
                  {"report", to_json(data.report)},
                  {"boxes", boxes}};
  OutputFile output(path);
  output.write(file.dump() + "\n");
  output.commit();
}

Surrogate load_surrogate(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  if (!input) throw InputOutputError("cannot read '" + path.string() + "'", errno);
  const std::string text{std::istreambuf_iterator<char>(input), {}};
  try {
    return surrogate_from(json::parse(text), path.string());
  } catch (const json::exception& error) {
    throw FileError(path.string(), 0, 0, std::string("not a surrogate: ") + error.what());
  } catch (const InvalidInput& error) {
    throw FileError(path.string(), 0, 0, std::string("not a surrogate: ") + error.what());
  }
}

}  // namespace strutt
