#include "core/loop/frame_now.hpp"

#include <algorithm>

#include "core/loop/bounded_json.hpp"
#include "core/loop/json_text.hpp"

namespace beadwork {

void FrameNow::add(const Moment& moment, const FramePlan& more) {
  if (!is_of(moment)) *this = {moment.step, moment.stage, true, {}};
  of_one_stage = of_one_stage && stage == moment.stage;
  stage = moment.stage;
  plan.picture |= more.picture;
  if (!more.view.empty()) plan.view = more.view;
  for (const std::string& field : more.fields)
    if (std::find(plan.fields.begin(), plan.fields.end(), field) == plan.fields.end()) plan.fields.push_back(field);
}

std::string FrameNow::json() const {
  return json_text(nlohmann::json{{"step", step},
                                  {"stage", stage},
                                  {"of_one_stage", of_one_stage},
                                  {"fields", plan.fields},
                                  {"picture", plan.picture},
                                  {"view", plan.view}});
}

std::optional<FrameNow> FrameNow::of(const std::string& text) {
  try {
    const auto json = bounded_json(text);
    return FrameNow{json.at("step").get<std::int64_t>(),
                    json.at("stage").get<int>(),
                    json.at("of_one_stage").get<bool>(),
                    {json.at("fields").get<std::vector<std::string>>(), json.at("picture").get<bool>(),
                     json.at("view").get<std::string>()}};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace beadwork
