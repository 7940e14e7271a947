#include "strutt/io/figure.hpp"

#include <algorithm>

#include "io/chart_writers.hpp"
#include "io/figure_file.hpp"
#include "io/figure_script.hpp"
#include "io/text.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

/// Small charts are drawn with so many pixels at least, so that no viewer smooths their cells.
constexpr std::size_t kFewestPixels = 500;

}  // namespace

struct ChartFigure::State {
  State(const std::filesystem::path& path, const ChartDescription& d)
      : file(path), description(d), data(d.request), order(d.request) {}

  FigureFile file;
  ChartDescription description;
  FigureData data;
  StripOrder order;
  TongueOverlay tongues;
};

ChartFigure::ChartFigure(const std::filesystem::path& path, const ChartDescription& description)
    : state_(std::make_unique<State>(path, description)) {}

ChartFigure::~ChartFigure() = default;

std::vector<Layer> ChartFigure::layers() { return {Layer::verdict, Layer::growth, Layer::margin}; }

void ChartFigure::add(const ChartStrip& strip) {
  state_->order.take(strip);
  state_->data.add(strip);
}

void ChartFigure::set_tongues(const std::vector<TongueCurve>& curves) {
  state_->tongues = TongueOverlay(curves, state_->description.request);
}

void ChartFigure::commit() {
  State& state = *state_;
  state.order.finish();
  const FigureData& data = state.data;
  FigureContent content{.format = state.file.format(), .scale = growth_scale(data), .labels = {}};
  content.repeat = std::max<std::size_t>(1, kFewestPixels / std::max(data.columns(), data.rows()));

  const GnuplotRun gnuplot;
  gnuplot.write(kCellsFile, image_bytes(data, content.scale, content.repeat));
  const auto edges = contour_lines(data.margin(), data.columns(), 0.0);
  content.has_edges = !edges.empty();
  content.tongues = state.tongues;
  gnuplot.write(kTonguesFile, state.tongues.data());
  gnuplot.write(kEdgesFile, line_data(edges, data));

  LabelPlacer placer(plot_size(data), edges);
  std::string growth;
  const auto growth_squared = data.signed_growth_squared();
  for (const double level : content.scale.levels) {
    auto lines = contour_lines(growth_squared, data.columns(), level * level);
    placer.place(lines, to_text(level));
    growth += line_data(lines, data);
  }
  content.labels = placer.labels();
  content.has_growth_lines = !growth.empty();
  gnuplot.write(kGrowthFile, growth);

  state.file.draw(gnuplot, figure_script(state.description, data, content));
}

}  // namespace strutt
