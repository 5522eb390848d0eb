/// Local details of strands, such as curls and kinks, taken from examples and given to others
/// (section 4.7 of the thesis).
#pragma once

#include "kernel/core/context.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

struct DetailOptions : StrandOperatorOptions {
    /// Bends shorter than so many metres are details, longer ones the course of a strand; positive.
    double span = 0.06;
    /// Size of the given details as a multiple of those of the examples; positive.
    double scale = 1.0;
    /// Details of each lock are turned about the strand, at random, by up to this part of a turn; 0
    /// to 1.
    double turn = 0.0;
    /// Strands with longer segments than their example get more points.
    bool resample = true;
};

/// Gives strands the details of examples in place of their own: the course of a strand stays. A
/// detail is a second derivative along the course and a distance from it, both in the frame of the
/// course, which turns as little as possible; the strand x that has them is the least of
///
///     sum |x'' - (b'' + R d)|^2 + (2 pi / span)^4 |x - (b + R e)|^2
///
/// with its root held, which is the equation of section 4.7 for one strand, b being its course, R
/// the frame, d and e the two parts of the detail. Strands of one guide take theirs from one
/// example, others each from its own, at random; strands longer than their example repeat a part of
/// it. With `keep_length` strands become shorter on the head, as if curled; without it longer. The
/// details of a strand that are given to it leave it as it is. Errors:
/// invalid_argument for options out of range, or examples without a finite strand of three points
/// and a length; not_finite; memory_limit, cancelled.
void add_detail(Strands& strands, const Strands& examples, const DetailOptions& options = {},
                const Context& context = {});

/// Returns the examples with straight courses that hang down from their roots: their details alone,
/// which can be saved as any strands and given to others. Strands of fewer than three points stay
/// as they are. Errors: invalid_argument for a span that is not positive and finite; memory_limit,
/// cancelled.
Strands details(const Strands& examples, double span = DetailOptions().span,
                const Context& context = {});

}  // namespace lissom
