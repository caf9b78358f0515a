//! Why the program does not take a way that is cheaper than its own somewhere.

/// The reason in one clause, for methods that have been looked at; none for others.
#[must_use]
pub fn reason(method: &str) -> Option<&'static str> {
    match method {
        "table, sums for this pulse only" => {
            Some("its sums know that this pulse is two exponentials, which no computed force is")
        }
        "cells alone" => Some(
            "its step is known beforehand, many times finer than that of the output; the program does not know how fine is \
             enough, and integrates the ends of the contact instead",
        ),
        "table, linear cells" => Some(
            "it reads a third of the numbers and needs a step many times finer as soon as more is asked; the program \
             takes it for forces with corners",
        ),
        "table, other nodes or points" => Some(
            "fewer nodes are enough at this place and not at the worst places of a table, for which its nodes are chosen",
        ),
        "implicit of order 2" => Some(
            "it knows the loss 1 - e^2 from the momentum alone, to the digits of the restitution and not to its own; what \
             the program's march takes longer at 1e-3 goes into the loss and the instant of separation",
        ),
        "wave implicit" | "growing" => Some(
            "its number of steps is known beforehand; the program does not know how many a tolerance needs, halves the \
             step until the results stand still, and pays for the coarser marches as well",
        ),
        _ => None,
    }
}
