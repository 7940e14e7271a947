#include "strutt/io/period_figure.hpp"

#include <algorithm>

#include "io/figure_file.hpp"
#include "io/period_script.hpp"
#include "strutt/base/error.hpp"

namespace strutt {

struct PeriodFigure::State : FigureFile {
  using FigureFile::FigureFile;
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
  state_->draw(gnuplot, period_script(samples, state_->format()));
}

}  // namespace strutt
