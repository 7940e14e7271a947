#include "portrait_output.hpp"

#include "exit_code.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"

namespace strutt::app {
namespace {

DataTable table_of(const std::vector<PhaseCurve>& curves, const std::string& title,
                   const Provenance& provenance) {
  std::vector<std::string> kinds;
  for (int k = 0; k < kCurveKindCount; ++k) kinds.emplace_back(to_string(static_cast<CurveKind>(k)));
  DataTable table{.title = title, .columns = {}, .provenance = provenance};
  table.columns = {{"curve", "1", "number of the curve", {}, {}},
                   {"kind", "", "kind of the curve", kinds, {}},
                   {"separatrix_excess", "1", "C1 - 2 = (phi'/alpha)^2 - 4 cos^2(phi/2)", {}, {}},
                   {"angle", "rad", "angle from the hanging position", {}, {}},
                   {"velocity", "rad/s", "angular velocity", {}, {}}};
  auto& c = table.columns;
  for (std::size_t n = 0; n < curves.size(); ++n) {
    for (const auto& p : curves[n].points) {
      c[0].values.push_back(static_cast<double>(n));
      c[1].values.push_back(static_cast<double>(curves[n].kind));
      c[2].values.push_back(curves[n].separatrix_excess);
      c[3].values.push_back(p.angle);
      c[4].values.push_back(p.velocity);
    }
  }
  return table;
}

}  // namespace

PortraitOutput::PortraitOutput(const PortraitArguments& arguments, const PortraitDescription& description)
    : path_(arguments.json ? json_path(arguments) : data_path(arguments)), description_(description) {
  if (!arguments.json) columns_.emplace(path_);
  if (!arguments.figure) return;
  figure_path_ = *arguments.figure;
  figure_.emplace(figure_path_);
}

void PortraitOutput::write(const std::vector<PhaseCurve>& curves, const Provenance& provenance) {
  if (columns_)
    columns_->write(table_of(curves, description_.title, provenance));
  else
    write_json(curves, provenance);
  throw_if_interrupted();
  if (figure_) figure_->draw(curves, description_);
}

void PortraitOutput::write_json(const std::vector<PhaseCurve>& curves, const Provenance& provenance) const {
  RowWriter writer(
      path_, true,
      {{"curve", "1"}, {"kind", ""}, {"separatrix_excess", "1"}, {"angle", "rad"}, {"velocity", "rad/s"}},
      provenance);
  std::vector<Cell> row;
  for (std::size_t n = 0; n < curves.size(); ++n) {
    for (const auto& p : curves[n].points) {
      row = {static_cast<double>(n), std::string(to_string(curves[n].kind)), curves[n].separatrix_excess,
             p.angle, p.velocity};
      writer.write(row);
    }
  }
  writer.commit();
}

std::string PortraitOutput::places() const {
  const std::string data = path_ == "-" ? "standard output" : path_.string();
  return figure_ ? data + " and " + figure_path_ : data;
}

}  // namespace strutt::app
