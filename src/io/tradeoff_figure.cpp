#include "strutt/io/tradeoff_figure.hpp"

#include <algorithm>
#include <cmath>

#include "io/figure_file.hpp"
#include "io/tradeoff_script.hpp"
#include "strutt/base/error.hpp"

namespace strutt {

struct TradeoffFigure::State : FigureFile {
  using FigureFile::FigureFile;
};

TradeoffFigure::TradeoffFigure(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {}

TradeoffFigure::~TradeoffFigure() = default;

void TradeoffFigure::draw(const Tradeoff& tradeoff, const std::string& title) {
  const bool drawable = std::any_of(tradeoff.rows.begin(), tradeoff.rows.end(), [](const TradeoffRow& row) {
    return std::isfinite(row.true_error) && row.points_per_second > 0.0;
  });
  if (!drawable) throw InvalidInput("a figure of speed and accuracy needs a row with an error");
  const GnuplotRun gnuplot;
  gnuplot.write(kTradeoffFile, tradeoff_data(tradeoff));
  state_->draw(gnuplot, tradeoff_script(tradeoff, title, state_->format()));
}

}  // namespace strutt
