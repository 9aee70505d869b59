// The last answer of a page as a file; docs/answer-format.md describes it, src/cfree/formats reads it.
#pragma once
#include "reply.hpp"
#include "world.hpp"

namespace cfree {

// `answer`: its text, where {sha256} stands for the hash of `scene`, the text that says which scene it is for. Throws
// std::invalid_argument if there is none, or if it slides.
void write_answer(const World& world, Reply& reply);

}  // namespace cfree
