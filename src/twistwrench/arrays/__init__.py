"""Input validation: arrays of numbers, single numbers, names and kinds of values.

Each file imports only from those above it in this table.

==============  ======================================================================================
file            what it checks
==============  ======================================================================================
exact           arrays of objects that are numbers: fractions, SymPy's expressions
kinds           arguments that are not arrays: flags, sequences, one of a few words
conversion      arguments become finite arrays of one number type
bounds          real numbers, finite numbers, numbers whose products cannot overflow
==============  ======================================================================================
"""

from .bounds import as_finite, as_real, check_overflow, check_size, without_overflow
from .conversion import (
    Array,
    as_array,
    as_arrays,
    as_constant,
    as_count,
    as_exactly,
    as_generator,
    as_names,
    as_number,
    as_number_array,
    as_number_arrays,
    check_batches,
    resolution,
    tolerance,
)
from .exact import beside, comparable, convert, elementary, exact_numbers, exact_unit, has_objects, home
from .kinds import as_flag, as_sequence, check_choice, check_kind

__all__ = [
    "Array",
    "as_array",
    "as_arrays",
    "as_constant",
    "as_count",
    "as_exactly",
    "as_finite",
    "as_flag",
    "as_generator",
    "as_names",
    "as_number",
    "as_number_array",
    "as_number_arrays",
    "as_real",
    "as_sequence",
    "beside",
    "check_batches",
    "check_choice",
    "check_kind",
    "check_overflow",
    "check_size",
    "comparable",
    "convert",
    "elementary",
    "exact_numbers",
    "exact_unit",
    "has_objects",
    "home",
    "resolution",
    "tolerance",
    "without_overflow",
]
