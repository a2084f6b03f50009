%module precessStateEffector

%include "architecture/utilities/bskException.swg"
%default_bsk_exception();

%{
   #include "precessStateEffector.h"
%}

%pythoncode %{
from Basilisk.architecture.swig_common_model import *
%}
%include "std_string.i"
%include "swig_eigen.i"
%include "swig_conly_data.i"

%include "sys_model.i"
%include "simulation/dynamics/_GeneralModuleFiles/dynamicEffector.h"
%include "simulation/dynamics/_GeneralModuleFiles/stateEffector.h"
%include "precessStateEffector.h"

%include "architecture/msgPayloadDefC/ArrayMotorTorqueMsgPayload.h"
struct ArrayMotorTorqueMsg_C;
%include "architecture/msgPayloadDefC/RWSpeedMsgPayload.h"
struct RWSpeedMsg_C;
%include "architecture/msgPayloadDefC/VSCMGArrayTorqueMsgPayload.h"
struct VSCMGArrayTorqueMsg_C;
%include "architecture/msgPayloadDefC/VSCMGSpeedMsgPayload.h"
struct VSCMGSpeedMsg_C;

%pythoncode %{
import sys
protectAllClasses(sys.modules[__name__])
%}
