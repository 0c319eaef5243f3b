#pragma once
#include <string_view>

namespace beadwork::report {

/// The page, with @title@, @style@, @header@ and @body@ to be filled in.
extern const std::string_view page_template;
/// By which a page that was made of it is known.
inline constexpr std::string_view maker_of_page = "<meta name=\"generator\" content=\"Beadwork\">";
/// The style sheet: light, dark and print.
extern const std::string_view page_style;

}  // namespace beadwork::report
