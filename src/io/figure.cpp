#include "strutt/io/figure.hpp"

#include <algorithm>

#include "io/chart_writers.hpp"
#include "io/figure_script.hpp"
#include "io/gnuplot.hpp"
#include "io/text.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {
namespace {

constexpr std::size_t kLargestPicture = std::size_t{1} << 30;
/// Small charts are drawn with so many pixels at least, so that no viewer smooths their cells.
constexpr std::size_t kFewestPixels = 500;

FigureFormat format_of(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".png") return FigureFormat::png;
  if (ending == ".svg") return FigureFormat::svg;
  if (ending == ".pdf") return FigureFormat::pdf;
  throw InvalidInput("the format of '" + printable(path.string()) + "' is not known: a figure ends with .png, .svg or .pdf");
}

}  // namespace

struct ChartFigure::State {
  State(const std::filesystem::path& path, const ChartDescription& d)
      : target(path), format(format_of(path)), file(path), description(d), data(d.request), order(d.request) {}

  std::filesystem::path target;
  FigureFormat format;
  OutputFile file;
  ChartDescription description;
  FigureData data;
  StripOrder order;
};

ChartFigure::ChartFigure(const std::filesystem::path& path, const ChartDescription& description)
    : state_(std::make_unique<State>(path, description)) {}

ChartFigure::~ChartFigure() = default;

std::vector<Layer> ChartFigure::layers() { return {Layer::verdict, Layer::growth, Layer::margin}; }

void ChartFigure::add(const ChartStrip& strip) {
  state_->order.take(strip);
  state_->data.add(strip);
}

void ChartFigure::commit() {
  State& state = *state_;
  state.order.finish();
  const FigureData& data = state.data;
  FigureContent content{.format = state.format, .scale = growth_scale(data), .labels = {}};
  content.repeat = std::max<std::size_t>(1, kFewestPixels / std::max(data.columns(), data.rows()));

  const GnuplotRun gnuplot;
  gnuplot.write(kCellsFile, image_bytes(data, content.scale, content.repeat));
  const auto edges = contour_lines(data.margin(), data.columns(), 0.0);
  content.has_edges = !edges.empty();
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

  gnuplot.write("figure.gp", figure_script(state.description, data, content));
  gnuplot.run("figure.gp", state.target);
  state.file.write(read_file(gnuplot / kPictureFile, kLargestPicture));
  state.file.commit();
}

}  // namespace strutt
