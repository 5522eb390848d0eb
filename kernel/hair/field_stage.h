/// FieldStage: the field of a hairstyle, as its claims have it; private to kernel/hair.
#pragma once

#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/curve_conflicts.h"
#include "kernel/hair/field/field_gravity.h"
#include "kernel/hair/field/hair_field.h"

namespace lissom {

/// Remembers the claims given to its field, so that a solve costs only as much as their change. The
/// field follows from the claims alone, to the bit.
class FieldStage {
  public:
    explicit FieldStage(HairField field) : field_(std::move(field)) {}

    const HairField& field() const { return field_; }
    /// Returns whether the field is that of these claims.
    bool solved(const std::vector<CurveClaim>& claims) const;
    /// Solves with gravity away from the claims of curves; all but its `styled` is taken from
    /// `gravity`, which must follow from the claims. After an error the values of the field are
    /// those of the last solve. Errors: as HairField::solve.
    void solve(const std::vector<CurveClaim>& claims, FieldGravity gravity, const Context& context);
    /// Same as HairField::put_back.
    void put_back(std::vector<float> values) { field_.put_back(std::move(values)); }

  private:
    // Owners are given in the order of their edits: then that is the order of the rows.
    void give(const std::vector<CurveClaim>& claims);

    HairField field_;
    // Claims in the order of edits; without empty ones.
    std::vector<CurveClaim> given_;
};

}  // namespace lissom
