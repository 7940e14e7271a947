#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "chart/cell_columns.hpp"
#include "chart/cell_row.hpp"
#include "chart/hill_model.hpp"
#include "chart/matrix_cell.hpp"
#include "chart/product_table.hpp"
#include "chart/reciprocal_cells.hpp"
#include "chart/surrogate_grid.hpp"
#include "chart/trace_boxes.hpp"
#include "chart/trace_runs.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// Whether D is all that a chart wants.
bool wants_trace_only(const ChartRequest& request);

/// A discriminant alone is interpolated once more, which takes its share of the error.
SurrogateOptions surrogate_options(const ChartRequest& request);

/// The cells of a chart from a surrogate, strip by strip.
class SurrogateCells {
 public:
  /// Builds the surrogate; see Surrogate::cancelled. For a scene that Surrogate::refusal accepts.
  SurrogateCells(const Scene& scene, const ChartRequest& request);

  const Surrogate& surrogate() const { return surrogate_; }

  /// Fills the cells of the strip whose error and verdict the surrogate can answer for, counts them in
  /// `summary` and puts the places of the others into `rest`, in order. False: cancelled.
  bool fill(ChartStrip& strip, ChartSummary& summary, std::vector<std::size_t>& rest);

 private:
  /// What a piece adds to the summary.
  struct Count {
    std::size_t cells = 0;
    double largest_error = 0.0;
    std::vector<std::size_t> open =
        {};  ///< places in the strip of the cells that the surrogate does not answer for
    Count& operator+=(const Count& other);
  };
  /// The turns of the factors at the ends of rows, see fill_factors.
  struct Edges {
    Turns left, right;
    bool agree = true;
  };
  struct Worker {
    std::vector<double> factors, traces, error, quarter_turns;
    CellRow cells;
    CellColumns columns;
    TraceRuns runs;
    std::unique_ptr<HillModel> model;    // kind half_period: to count turns
    std::unique_ptr<MatrixCell> matrix;  // kind period
  };
  /// A piece that is being filled.
  struct PieceWork {
    const GridPiece& piece;
    ChartStrip& strip;
    Worker& worker;
    Edges& edges;
    bool along_rows;                    ///< turns are counted along each row
    bool plain;                         ///< plain_cells takes it
    std::optional<double> trace_bound;  ///< of the error of D, where D alone is to tell cells
  };

  void prepare_factors(const Scene& scene);
  TraceScale trace_scale() const;
  static std::vector<std::size_t> rest_of(const ChartStrip& strip, const std::vector<GridPiece>& pieces,
                                          const std::vector<Count>& counts);
  Count fill_piece(const GridPiece& piece, ChartStrip& strip, Worker& worker);
  Count fill_traces(const GridPiece& piece, ChartStrip& strip, Worker& worker);
  void damp(const GridPiece& piece, double* values, std::size_t stride, Worker& worker) const;
  Count fill_matrices(const GridPiece& piece, ChartStrip& strip, Worker& worker);
  Count fill_factors(const GridPiece& piece, ChartStrip& strip, Worker& worker);
  std::optional<Count> fill_rows(const GridPiece& piece, ChartStrip& strip, Worker& worker, bool along_rows);
  std::optional<double> bound_of_trace(const GridPiece& piece) const;
  Count fill_row(const GridPiece& row, const double* trace, PieceWork& work) const;
  void find_runs(const GridPiece& row, const double* trace, PieceWork& work) const;
  Count fill_by_factors(const GridPiece& cells, PieceWork& work) const;
  Count fill_by_trace(const GridPiece& cells, const double* trace, PieceWork& work) const;
  Count fill_cells(const GridPiece& cells, ChartStrip& strip, Worker& worker, bool is_plain) const;
  Count single_cells(const GridPiece& cells, ChartStrip& strip, Worker& worker, bool is_plain) const;
  void prepare(const GridPiece& cells, Worker& worker) const;
  void start_row(const GridPiece& cells, const GridPiece& piece, Edges& edges, Worker& worker) const;
  void end_row(const GridPiece& cells, const GridPiece& piece, Edges& edges, Worker& worker) const;
  Turns turns_at(const GridPiece& cells, std::size_t c, Worker& worker) const;
  void count_turns(const GridPiece& cells, Worker& worker) const;

  ChartRequest request_;
  bool with_verdict_ = false, with_winding_ = false;
  ParallelOptions parallel_;
  Surrogate surrogate_;
  SurrogateGrid grid_;
  SurrogateGrid traces_;  ///< D of boxes of half-period factors, where it can be had; empty for other kinds
  ProductTable half_damping_, kappa_square_;
  std::optional<ReciprocalCells> reciprocal_;  // kind period, where it serves
  std::vector<Worker> workers_;
};

}  // namespace strutt
