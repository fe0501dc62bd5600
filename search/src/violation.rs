//! What must not happen.

/// Numbers are those of machines, which are those of their instances.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Violation {
    /// A fault at run time: index into the faults of the model.
    Fault { instance: usize, fault: usize },
    /// A property is violated that only warns: index into the faults of the model.
    Warning { instance: usize, fault: usize },
    /// A property stops the machine: index into the faults of the model. The others go on.
    MachineStops { instance: usize, fault: usize },
    /// From here the goal of a property, which is waited for, cannot come any more.
    NeverFollowed { instance: usize, fault: usize },
    /// None: the line stops as its types say, until an operator has come. What follows is not searched. Index into the
    /// faults of the model.
    Stop { fault: usize },
    /// The same, and once an operator has come it stops again in the next scan, each time, while no device does anything.
    StopsAgain,
    /// The same, and the scan in which it goes on once an operator has come ends in a fault.
    FaultBehindStop { instance: usize, fault: usize },
    /// From here the orders cannot be made any more, whatever happens.
    NeverMade,
    /// All orders are made, and from here the line cannot come to rest any more, although nothing has failed.
    NeverRests,
    /// Nothing is ordered, and from here nothing ever changes but inputs by themselves, although nothing has failed.
    ComesToAStand,
    /// The device of this instance has not failed, orders are to be made, and the line does nothing until a time of the instance
    /// has passed.
    WaitsForTime { instance: usize },
    /// A machine is given the command again that is under way.
    Repeats { machine: usize },
    /// An arm sets out with its gripper still on and empty, and not straight down to grip.
    OnAndEmpty { arm: usize },
    /// An arm is to grip at a place at which nothing lies.
    NothingThere { arm: usize, machine: usize, slot: usize },
    /// An arm leaves a slot sideways, so low that it touches items beside it.
    LeavesSideways { arm: usize, machine: usize },
    /// Two arms are over one place.
    TwoArms { arms: [usize; 2], machine: usize },
    /// A machine moves while an arm is at it.
    MovesUnder { machine: usize, arm: usize },
    /// An arm puts an item where one lies.
    ItemOnItem { arm: usize, machine: usize, slot: usize },
    /// An arm lets an item fall onto a place.
    Dropped { arm: usize, machine: usize },
    /// An arm puts an item at a place where one lies among the slots.
    ItemAmongItems { arm: usize, machine: usize },
    /// A station asks for its place to be taken away, and what lies there is not what was ordered.
    WrongItems { machine: usize, order: usize },
}
