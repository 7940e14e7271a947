#pragma once

#include "arguments.hpp"
#include "exit_code.hpp"

namespace strutt::app {

ExitCode run(const Information& information);
ExitCode run(const ChartArguments& arguments);
ExitCode run(const StabilityArguments& arguments);
ExitCode run(const MotionArguments& arguments);
ExitCode run(const CharacteristicArguments& arguments);
ExitCode run(const TonguesArguments& arguments);
ExitCode run(const MarginArguments& arguments);
ExitCode run(const PeriodArguments& arguments);
ExitCode run(const NormalFormArguments& arguments);
ExitCode run(const PortraitArguments& arguments);
ExitCode run(const TradeoffArguments& arguments);

}  // namespace strutt::app
