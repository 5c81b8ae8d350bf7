! rule: keywords and names are compared without case
! source: [K §2.3]
module Demo
    Var Num A;
    Proc Main()
        If a = 1 Then
            A := 2;
        EndIf
    EndProc
endmodule
