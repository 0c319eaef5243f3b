#pragma once
// The table of a curve, in the words of the report.

#include "core/base/curve_table.hpp"

namespace beadwork::report {

using Column = CurveValues;
using Table = CurveTable;
using beadwork::parse_table;

}  // namespace beadwork::report
