#pragma once
#include <string_view>

namespace beadwork::report {

/// The page, with @title@, @style@, @header@ and @body@ to be filled in.
extern const std::string_view page_template;
/// The style sheet: light, dark and print.
extern const std::string_view page_style;

}  // namespace beadwork::report
