#pragma once

/// What stands below the flags of --help.
namespace strutt::app {

inline constexpr const char* kExitCodes = R"(
Exit codes: 0 done; 1 done, but something asked for is unresolved or not converged; 2 wrong flag; 3 wrong scene or
  CSV file; 4 over the memory budget; 5 input/output; 6 numerical failure; 7 internal; 128+n signal n.)";

inline constexpr const char* kChartExample = R"(
Example:
  printf '[mathieu]\nepsilon = 0.5\n' > scene.toml
  strutt chart scene.toml --x mathieu.delta=-1:5:60 --y mathieu.epsilon=0:6:40 -o chart.csv
)";

inline constexpr const char* kStabilityExample = R"(
Example:
  printf '[mathieu]\ndelta = 1\nepsilon = 0.5\n' > scene.toml
  printf 'mathieu.delta\n0.2\n0.3\n' > points.csv
  strutt stability scene.toml --points points.csv
)";

inline constexpr const char* kMotionExample = R"(
Example:
  printf '[pendulum]\nlength = 1\n[support]\nfrequency = 12\namplitude = 0.05\n' > scene.toml
  strutt motion scene.toml --angle "30 deg" --velocity 0 --duration 2 --samples 21
)";

inline constexpr const char* kNormalFormExample = R"(
Example (the pendulum: delta = 0, beta = -1/16):
  printf 'alpha,f2_30\n1,0.16666666666666667\n' > coefficients.csv
  strutt normal-form --points coefficients.csv
)";

inline constexpr const char* kPeriodExample = R"(
Example:
  strutt period --amplitude "90 deg" --compare
  printf 'from_top\n1e-300\n0.1\n' | strutt period --points -
)";

inline constexpr const char* kTonguesExample = R"(
Examples:
  printf '[mathieu]\nepsilon = 0.01\n' > scene.toml
  strutt tongues scene.toml --along mathieu.delta=-1:40
  strutt tongues scene.toml --along mathieu.delta=-1:5 --over mathieu.epsilon=0:5 -o curves.csv
)";

inline constexpr const char* kMarginExample = R"(
Examples:
  printf '[pendulum]\nlength = 1\n[support]\nfrequency = 12\namplitude = 0.05\n' > scene.toml
  strutt margin scene.toml --parameters support.frequency,support.amplitude
  strutt margin scene.toml --bands support.frequency=2:30
  strutt margin scene.toml --closing-damping support.frequency=2:30
  strutt margin scene.toml --box support.frequency=11:13,pendulum.length=0.9:1.1
  strutt margin scene.toml --sensitivities --edge support.frequency
)";

inline constexpr const char* kCharacteristicExample = R"(
Example:
  strutt characteristic --order 0:10 --q 5,-5
)";

inline constexpr const char* kPortraitExample = R"(
Examples:
  strutt portrait --cells 2 -o portrait.csv
  printf '[pendulum]\nlength = 1\n[support]\nfrequency = 12\namplitude = 0.02\n' > scene.toml
  strutt portrait scene.toml --curves 10 --sections 20 -o sections.npz || test $? -eq 1
)";

inline constexpr const char* kTradeoffExample = R"(
Example:
  printf '[mathieu]\ndelta = 1\nepsilon = 0.5\n' > scene.toml
  strutt tradeoff scene.toml -o tradeoff.csv --figure tradeoff.png
)";

}  // namespace strutt::app
