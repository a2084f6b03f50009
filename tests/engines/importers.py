"""One instance of a functional mock-up unit in FMPy, by the same calls whichever version of FMI it is of."""

import ctypes

from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave


def instance(description, folder, exchanges=False, name="unit"):
    """An instance that is initialised at 0 s; of Model Exchange, or of Co-Simulation."""
    kind = OfThree if description.fmiVersion.startswith("3.") else OfTwo
    return kind(description, folder, exchanges, name)


class Instance:
    """What both versions have under the same names."""

    KINDS = ()

    def __init__(self, description, folder, exchanges, name):
        side = description.modelExchange if exchanges else description.coSimulation
        self.one = self.KINDS[exchanges](
            guid=description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=side.modelIdentifier,
            instanceName=name,
        )
        self.one.instantiate()
        self.initialise()

    def set_states(self, x):
        self.one.setContinuousStates((ctypes.c_double * len(x))(*x), len(x))

    def enter_event_mode(self):
        self.one.enterEventMode()

    def step(self, time, size):
        return self.one.doStep(currentCommunicationPoint=time, communicationStepSize=size)

    def close(self):
        self.one.terminate()
        self.one.freeInstance()


class OfTwo(Instance):
    """FMI 2.0."""

    KINDS = (FMU2Slave, FMU2Model)

    def initialise(self):
        self.one.setupExperiment(startTime=0.0)
        self.one.enterInitializationMode()
        self.one.exitInitializationMode()

    def get(self, places):
        return self.one.getReal(places)

    def set(self, places, values):
        self.one.setReal(places, values)

    def along(self, unknowns, knowns, seed):
        return self.one.getDirectionalDerivative(unknowns, knowns, seed)

    def gradient(self, unknowns, knowns, seed):
        """FMI 2.0 has none."""

    def enter_continuous_time(self):
        self.one.newDiscreteStates()
        self.one.enterContinuousTimeMode()

    def state(self):
        return self.one.getFMUstate()

    def set_state(self, state):
        self.one.setFMUstate(state)

    def free_state(self, state):
        self.one.freeFMUstate(state)

    def to_bytes(self, state):
        return self.one.serializeFMUstate(state)

    def of_bytes(self, stored):
        return self.one.deSerializeFMUstate(stored)


class OfThree(Instance):
    """FMI 3.0."""

    KINDS = (FMU3Slave, FMU3Model)

    def initialise(self):
        self.one.enterInitializationMode(startTime=0.0)
        self.one.exitInitializationMode()

    def get(self, places):
        return self.one.getFloat64(places)

    def set(self, places, values):
        self.one.setFloat64(places, values)

    def along(self, unknowns, knowns, seed):
        return self.one.getDirectionalDerivative(unknowns, knowns, seed, len(unknowns))

    def gradient(self, unknowns, knowns, seed):
        return self.one.getAdjointDerivative(unknowns, knowns, seed, len(knowns))

    def enter_continuous_time(self):
        self.one.updateDiscreteStates()
        self.one.enterContinuousTimeMode()

    def state(self):
        return self.one.getFMUState()

    def set_state(self, state):
        self.one.setFMUState(state)

    def free_state(self, state):
        self.one.freeFMUState(state)

    def to_bytes(self, state):
        return self.one.serializeFMUState(state)

    def of_bytes(self, stored):
        return self.one.deserializeFMUState(stored)

    def step(self, time, size):
        needs_event, ends, early, reached = super().step(time, size)
        if needs_event or ends or early or reached != time + size:
            raise RuntimeError(f"a step from {time} s over {size} s: {needs_event} {ends} {early} {reached}")
