#include "strutt/io/period_figure.hpp"

#include <algorithm>

#include "io/gnuplot.hpp"
#include "io/period_script.hpp"
#include "io/text.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {

struct PeriodFigure::State {
  explicit State(const std::filesystem::path& path) : target(path), format(figure_format(path)), file(path) {}

  std::filesystem::path target;
  FigureFormat format;
  OutputFile file;
};

PeriodFigure::PeriodFigure(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {}

PeriodFigure::~PeriodFigure() = default;

void PeriodFigure::draw(std::vector<PeriodSample> samples) {
  std::sort(samples.begin(), samples.end(),
            [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  if (samples.empty() || samples.front().amplitude == samples.back().amplitude)
    throw InvalidInput("a figure of periods needs librations of two amplitudes or more");
  const GnuplotRun gnuplot;
  gnuplot.write(kPeriodFile, period_data(samples));
  gnuplot.write("period.gp", period_script(samples, state_->format));
  gnuplot.run("period.gp", state_->target);
  state_->file.write(read_file(gnuplot / kPictureFile, kLargestPicture));
  state_->file.commit();
}

}  // namespace strutt
