!=== list_from_one
MODULE list_from_one
    ! source: [mem] the other answer about \ListNo: from 1, 0 follows the last
    ! dialect: list_number=one
    ! signal: doLamp DO
    ! signal: diSwitch DI
    ! expect: doLamp 2
    ! expect: diSwitch 0
    ! expect: out of bounds
    PROC main()
        VAR num number := 1;
        VAR string name;
        WHILE number > 0 DO
            ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
            TPWrite name + " " + ValToStr(number);
        ENDWHILE
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
    ERROR
        IF ERRNO = ERR_CFG_OUTOFBND TPWrite "out of bounds";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== missing
MODULE missing
    ! source: what nothing here stands behind is said, and stops the task where it is reached
    ! expect: before
    ! fault: 194001 9
    VAR egmident id;

    PROC main()
        TPWrite "before";
        EGMActMove id, tool0.tframe;
        TPWrite "never";
    ENDPROC
ENDMODULE
!=== modules
MODULE modules
    ! source: [manual] S4 Load, UnLoad, StartLoad, WaitLoad; CheckProgRef, late binding [K §4.5]
    ! expect: FALSE
    ! expect: part 1
    ! expect: ERR_LOADED
    ! expect: TRUE
    ! expect: ERR_REFUNKPRC
    ! expect: ERR_UNLOAD
    ! expect: ERR_FILNOTFND
    ! expect: part 2
    ! expect: ERR_SYNTAX
    ! expect: ERR_LINKREF
    PROC main()
        VAR loadsession session;
        part "1", "TPWrite ""part 1"";";
        TPWrite ValToStr(ModExist("part1"));
        Load \Dynamic, "HOME:/part1.mod";
        %"part1_run"%;
        Load \Dynamic, "HOME:/part1.mod";
        TPWrite ValToStr(ModExist("part1"));
        UnLoad "HOME:/part1.mod";
        %"part1_run"%;
        UnLoad "HOME:/part1.mod";
        StartLoad \Dynamic, "HOME:/none.mod", session;
        WaitLoad session;
        part "2", "TPWrite ""part 2"";";
        StartLoad \Dynamic, "HOME:" \File:="part2.mod", session;
        WaitLoad session;
        %"part2_run"%;
        part "3", "TPWrite ""part 3"" THEN;";
        Load \Dynamic, "HOME:/part3.mod";
        part "4", "undeclared_name;";
        Load \Dynamic, "HOME:/part4.mod" \CheckRef;
    ERROR
        TEST ERRNO
        CASE ERR_LOADED:
            TPWrite "ERR_LOADED";
        CASE ERR_REFUNKPRC:
            TPWrite "ERR_REFUNKPRC";
        CASE ERR_UNLOAD:
            TPWrite "ERR_UNLOAD";
        CASE ERR_FILNOTFND:
            TPWrite "ERR_FILNOTFND";
        CASE ERR_SYNTAX:
            TPWrite "ERR_SYNTAX";
        CASE ERR_LINKREF:
            TPWrite "ERR_LINKREF";
        ENDTEST
        TRYNEXT;
    ENDPROC

    PROC part(string number, string statement)
        VAR iodev file;
        Open "HOME:" \File:="part" + number + ".mod", file \Write;
        Write file, "MODULE part" + number;
        Write file, "PROC part" + number + "_run()";
        Write file, statement;
        Write file, "ENDPROC";
        Write file, "ENDMODULE";
        Close file;
    ENDPROC
ENDMODULE
!=== parameters
MODULE parameters
    ! source: 3HAC16581-1 ReadCfgData: /DOMAIN/TYPE/INSTANCE [manual]; \ListNo [mem]
    ! signal: doLamp DO
    ! signal: diSwitch DI
    ! expect: DO
    ! expect: TRUE
    ! expect: not found
    ! expect: wrong type
    ! expect: doLamp 1
    ! expect: diSwitch -1
    ! expect: out of bounds
    ! expect: out of bounds
    ! expect: doLamp
    PROC main()
        VAR string text;
        VAR num upper;
        VAR num lower;
        ReadCfgData "/EIO/EIO_SIGNAL/doLamp", "SignalType", text;
        TPWrite text;
        ReadCfgData "/SYS/CAB_TASKS/T_ROB1", "Type", text;
        TPWrite ValToStr(text = "NORMAL");
        ReadCfgData "/EIO/EIO_SIGNAL/none", "SignalType", text;
        ReadCfgData "/EIO/EIO_SIGNAL/doLamp", "SignalType", upper;
        each;
    ERROR
        IF ERRNO = ERR_CFG_NOTFND TPWrite "not found";
        IF ERRNO = ERR_CFG_ILLTYPE TPWrite "wrong type";
        TRYNEXT;
    ENDPROC

    PROC each()
        VAR num number := 0;
        VAR string name;
        WHILE number >= 0 DO
            ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
            TPWrite name + " " + ValToStr(number);
        ENDWHILE
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
        number := 2;
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name \ListNo:=number;
        ReadCfgData "/EIO/EIO_SIGNAL", "Name", name;
        TPWrite name;
    ERROR
        IF ERRNO = ERR_CFG_OUTOFBND TPWrite "out of bounds";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== modal_payload_mode
MODULE modal_payload_mode
    ! source: SYS_MISC of backups with RobotWare 6: ModalPayLoadMode 1; ABB's StateMachine add-in compares with 1 [ABB]
    ! expect: 1
    PROC main()
        TPWrite ValToStr(GetModalPayLoadMode());
    ENDPROC
ENDMODULE
!=== persistent_of_a_module
MODULE persistent_of_a_module
    ! source: [K §14.4] a system-global PERS is there while a module that declares it is loaded; only
    ! then does an initial value count. [VC 6.15] A module that is loaded again has its declared values
    ! task: T_TWO second
    ! expect: 5 7
    ! expect: 8 9
    ! expect: 5 9
    ! expect: 9
    PERS num common := 7;
    PERS num loaded := 0;
    PROC main()
        VAR iodev file;
        Open "HOME:" \File:="part.mod", file \Write;
        Write file, "MODULE part";
        Write file, "PERS num alone := 5;";
        Write file, "PERS num common := 1;";
        Write file, "PROC show()";
        Write file, "TPWrite ValToStr(alone) + "" "" + ValToStr(common);";
        Write file, "alone := 8; common := 9;";
        Write file, "ENDPROC";
        Write file, "ENDMODULE";
        Close file;
        Load "HOME:/part.mod";
        %"show"%;
        %"show"%;
        UnLoad "HOME:/part.mod";
        Load "HOME:/part.mod";
        %"show"%;
        loaded := 1;
    ENDPROC
    PROC second()
        WaitUntil loaded = 1;
        TPWrite ValToStr(common);
    ENDPROC
ENDMODULE
!=== procerr_recovery
MODULE procerr_recovery
    ! source: [K §7.4] asynchronously raised errors, of the example there
    ! robot: irb120
    ! signal: diFail DI
    ! expect: begins
    ! expect: process ERR_PATH_STOP, stopped TRUE
    ! expect: at the end
    ! expect: logged
    ! expect: process ERR_PATH_STOP, stopped TRUE
    ! expect: logged
    ! expect: at the end
    ! expect: logs
    ! expect: process ERR_PATH_STOP, stopped TRUE
    ! expect: logs
    ! expect: logged
    ! expect: at the end
    VAR intnum fails;
    VAR num kind := 1;
    CONST jointtarget a := [[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget b := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC main()
        CONNECT fails WITH failure;
        ITimer \Single, 0.3, fails;
        TPWrite "begins";
        one_move;
        ! SyncLast while PP is in a routine without moves: it waits for the next move
        order;
        two_moves;
        kind := 2;
        order;
        with_a_log;
        IDelete fails;
    ERROR
        TPWrite "never";
        TRYNEXT;
    ENDPROC

    PROC order()
        IDelete fails;
        CONNECT fails WITH failure;
        ITimer \Single, 0.3, fails;
    ENDPROC

    PROC one_move()
        MoveAbsJ a, v200, fine, tool0;
        IF reached(a) TPWrite "at the end";
    ERROR
        recover;
        RETRY;
    ENDPROC

    PROC two_moves()
        MoveAbsJ \Conc, b, v200, z10, tool0;
        write_log;
        MoveAbsJ a, v200, z10, tool0;
        TPWrite "logged";
        WaitRob \InPos;
        IF reached(a) TPWrite "at the end";
    ERROR
        recover;
        RETRY;
    ENDPROC

    PROC with_a_log()
        MoveAbsJ \Conc, b, v200, z10, tool0;
        talk;
        WaitRob \InPos;
        IF reached(b) TPWrite "at the end";
    ERROR
        recover;
        RETRY;
    ENDPROC

    PROC talk()
        TPWrite "logs";
        write_log;
    ERROR
        TPWrite "never";
    ENDPROC

    PROC write_log()
        VAR num n;
        WHILE n < 100 DO
            n := n + 1;
            WaitTime 0.01;
        ENDWHILE
        TPWrite "logged";
    ENDPROC

    PROC recover()
        IF ERRNO = ERR_PATH_STOP TPWrite "process ERR_PATH_STOP, stopped " \Bool:=IsStopMoveAct(\FromMoveTask);
        StartMove;
    ENDPROC

    FUNC bool reached(jointtarget point)
        VAR jointtarget here;
        here := CJointT();
        RETURN Abs(here.robax.rax_1 - point.robax.rax_1) < 0.01;
    ENDFUNC

    TRAP failure
        IF kind = 1 ProcerrRecovery \SyncLastMoveInst;
        IF kind = 2 ProcerrRecovery \SyncOrgMoveInst;
        RETURN;
    ENDTRAP
ENDMODULE
!=== saving
MODULE saving
    ! source: [K §2.18, 2.23] a saved module holds the present value of its persistents; S4 Save
    ! expect: PERS pos where:=[1.5,2,0.1]; ! kept
    ! expect: ERR_PATH
    ! expect: ERR_MODULE
    PERS pos where:=[0,0,0]; ! kept
    PERS num other;

    PROC main()
        VAR iodev file;
        VAR string line;
        where := [1.5,2,0.1];
        Save "saving" \FilePath:="HOME:/copy.mod";
        Open "HOME:/copy.mod", file \Read;
        WHILE line <> EOF DO
            line := ReadStr(file);
            IF StrLen(line) > 14 THEN
                IF StrPart(line, 1, 14) = "    PERS pos w" TPWrite StrPart(line, 5, StrLen(line) - 4);
            ENDIF
        ENDWHILE
        Close file;
        Save "saving";
        Save "nothing" \FilePath:="HOME:/copy.mod";
    ERROR
        IF ERRNO = ERR_PATH TPWrite "ERR_PATH";
        IF ERRNO = ERR_MODULE TPWrite "ERR_MODULE";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== search_predefined
MODULE search_predefined
    ! source: Keyence's CV-X modules [code] find tool0 and wobj0 by a search
    ! expect: tool_b tool0
    ! expect: wobj0
    ! expect: tool_b
    ! expect: tool_b
    ! expect: nothing
    ! expect: 0.001
    PERS tooldata tool_b := [TRUE,[[0,0,5],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    VAR datapos block;
    VAR string name;

    PROC main()
        VAR tooldata found;
        SetDataSearch "tooldata" \Object:="tool.*";
        logged;
        SetDataSearch "wobjdata" \Object:="wobj0";
        logged;
        SetDataSearch "tooldata" \InTask;
        logged;
        SetDataSearch "tooldata" \InMod:="search_predefined";
        logged;
        SetDataSearch "tooldata" \Object:="tool0" \VarSym;
        logged;
        SetDataSearch "tooldata" \Object:="tool0";
        IF GetNextSym(name, block \Recursive) THEN
            GetDataVal name \Block:=block, found;
            TPWrite ValToStr(found.tload.mass);
        ENDIF
    ENDPROC

    PROC logged()
        VAR string names := "";
        WHILE GetNextSym(name, block \Recursive) DO
            IF names <> "" names := names + " ";
            names := names + name;
        ENDWHILE
        IF names = "" names := "nothing";
        TPWrite names;
    ENDPROC
ENDMODULE
!=== symbols
MODULE symbols
    ! source: 3HAC16581-1 GetDataVal, SetDataVal, SetDataSearch, GetNextSym [manual]; error pairing [mem]
    ! robot: irb120
    ! expect: 7
    ! expect: 9
    ! expect: 4
    ! expect: 5
    ! expect: my_a my_b
    ! expect: ERR_SYM_ACCESS
    ! expect: ERR_SYM_ACCESS
    ! expect: ERR_SYMBOL_TYPE
    ! expect: hidden 3
    ! expect: 11 11 3 1
    ! expect: tool0
    ! expect: gripper 5
    ! expect: gripper
    VAR num my_a := 7;
    PERS num my_b := 8;
    CONST num my_c := 1;
    LOCAL VAR num hidden := 3;
    VAR num list{3} := [4,5,6];
    PERS tooldata gripper := [TRUE,[[0,0,5],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];

    PERS tooldata tool := [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];

    PROC main()
        VAR num n;
        VAR string s;
        VAR string name;
        VAR string names := "";
        VAR datapos block;
        VAR num same := 11;
        GetDataVal "my_a", n;
        TPWrite ValToStr(n);
        SetDataVal "my_b", 9;
        TPWrite ValToStr(my_b);
        GetDataVal "list{1}", n;
        TPWrite ValToStr(n);
        SetDataVal "list{3}", 5;
        TPWrite ValToStr(list{3});
        SetDataSearch "num" \Object:="my_.*" \PersSym \VarSym;
        WHILE GetNextSym(name, block \Recursive) DO
            IF names <> "" names := names + " ";
            names := names + name;
        ENDWHILE
        TPWrite names;
        GetDataVal "nothing", n;
        SetDataVal "my_c", 2;
        GetDataVal "my_a", s;
        SetDataSearch "num" \Object:="hidden" \LocalSym;
        IF GetNextSym(name, block \Recursive) THEN
            GetDataVal name \Block:=block, n;
            TPWrite name + " " + ValToStr(n);
        ENDIF
        SetAllDataVal "num" \Object:="my_.*", same;
        TPWrite ValToStr(my_a) + " " + ValToStr(my_b) + " " + ValToStr(hidden) + " " + ValToStr(my_c);
        GetSysData tool \ObjectName:=name;
        TPWrite name;
        SetSysData gripper;
        GetSysData tool \ObjectName:=name;
        TPWrite name + " " + ValToStr(tool.tframe.trans.z);
        SetSysData tool \ObjectName:="gripper";
        GetSysData tool \ObjectName:=name;
        TPWrite name;
    ERROR
        IF ERRNO = ERR_SYM_ACCESS TPWrite "ERR_SYM_ACCESS";
        IF ERRNO = ERR_SYMBOL_TYPE TPWrite "ERR_SYMBOL_TYPE";
        TRYNEXT;
    ENDPROC
ENDMODULE
